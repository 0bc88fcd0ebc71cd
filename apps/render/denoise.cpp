#include "render/denoise.h"

#include <algorithm>
#include <cmath>

#include "render/parallel.h"

namespace brickfall::render {

namespace {

using appearance::brightness;

constexpr int kRounds = 4;        // neighbours 1, 2, 4 and 8 pixels away: a mean over some 30 x 30
constexpr float kLightRange = 3;  // standard deviations of noise that two neighbours may differ by; more blurs shade
constexpr float kAroundShare =
    0.5f;  // of the spread among neighbours that counts as noise: more blurs where shade ends
constexpr float kLeastRange =
    0.04f;  // share of its light that may always differ: less keeps grains of pixels that are sure and wrong
constexpr float kPlaneRange = 2;  // pixels' widths that a neighbour may lie off the surface

struct Guide {
  Vec3f position, normal;
  float width = 0;  // m, of a pixel there
  float covered = 0;
};

// Four at a time: red, green, blue and variance.
using Four = float __attribute__((vector_size(16)));
struct Light {
  Four value{0, 0, 0, 0};
  float brightness = 0;
};
Light lightOf(Four value) { return {value, brightness({value[0], value[1], value[2]})}; }

class Filter {
 public:
  Filter(Picture& picture, const CameraRays& rays, int threads)
      : picture_(picture), threads_(threads), guides_(picture.texels.size()), from_(picture.texels.size()), to_(from_) {
    forRows(picture.height, threads, [&](int y) {
      for (int x = 0; x < picture.width; x++) {
        const Texel& texel = picture.at(x, y);
        const Ray ray = rays.through(float(x) + 0.5f, float(y) + 0.5f, 0.5f);
        guides_[index(x, y)] = {ray.origin + ray.direction * texel.depth, texel.normal, texel.depth * rays.pixelAngle(),
                                texel.covered};
        from_[index(x, y)] = lightOf(Four{texel.sky.x, texel.sky.y, texel.sky.z, texel.variance});
      }
    });
  }

  void run() {
    for (int round = 0; round < kRounds; round++) {
      forRows(picture_.height, threads_, [&](int y) {
        for (int x = 0; x < picture_.width; x++) to_[index(x, y)] = mean(x, y, 1 << round);
      });
      std::swap(from_, to_);
    }
    for (std::size_t k = 0; k < from_.size(); k++)
      picture_.texels[k].sky = {from_[k].value[0], from_[k].value[1], from_[k].value[2]};
  }

 private:
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(picture_.width) + std::size_t(x); }
  float smoothVariance(int x, int y) const;
  Light mean(int x, int y, int step) const;

  Picture& picture_;
  int threads_;
  std::vector<Guide> guides_;
  std::vector<Light> from_, to_;
};

constexpr float kWeights[2] = {0.5f, 0.25f};  // by distance, along each axis

// That of one pixel, from few samples, is itself little to be trusted. After the first round it is a mean anyway.
// Pixels that are sure and wrong, since both of their samples met the same, are found by how much they differ from those around them.
float Filter::smoothVariance(int x, int y) const {
  float variance = 0, light = 0, squares = 0, weights = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, picture_.height - 1); j++)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, picture_.width - 1); i++) {
      const std::size_t k = index(i, j);
      const float weight = kWeights[std::abs(i - x)] * kWeights[std::abs(j - y)] * guides_[k].covered;
      variance += weight * from_[k].value[3];
      light += weight * from_[k].brightness;
      squares += weight * from_[k].brightness * from_[k].brightness;
      weights += weight;
    }
  if (weights <= 0) return 0;
  const float mean = light / weights, around = squares / weights - mean * mean;
  return std::max(variance / weights, kAroundShare * around);
}

Light Filter::mean(int x, int y, int step) const {
  const std::size_t here = index(x, y);
  const Guide& guide = guides_[here];
  const Light& own = from_[here];
  if (guide.covered <= 0) return own;
  const float deviation = std::sqrt(step == 1 ? smoothVariance(x, y) : own.value[3]);
  const float range = 1 / (kLightRange * deviation + kLeastRange * own.brightness + 1e-4f);
  const float plane = 1 / (kPlaneRange * guide.width + 1e-5f);
  float weights = kWeights[0] * kWeights[0] * guide.covered;
  Four sum = own.value * Four{weights, weights, weights, weights * weights};
  for (int j = -1; j <= 1; j++) {
    const int v = y + j * step;
    if (v < 0 || v >= picture_.height) continue;
    for (int i = -1; i <= 1; i++) {
      const int u = x + i * step;
      if ((i == 0 && j == 0) || u < 0 || u >= picture_.width) continue;
      const std::size_t k = index(u, v);
      const Guide& other = guides_[k];
      const float turned = std::max(dot(guide.normal, other.normal), 0.0f), t2 = turned * turned,
                  t8 = t2 * t2 * t2 * t2;
      const float off = dot(guide.normal, other.position - guide.position) * plane, off2 = off * off;
      const float apart = (from_[k].brightness - own.brightness) * range, apart2 = apart * apart;
      const float weight = kWeights[std::abs(i)] * kWeights[std::abs(j)] * other.covered * t8 * t8 /
                           ((1 + off2 * off2) * (1 + apart2 * apart2));
      sum += from_[k].value * Four{weight, weight, weight, weight * weight};
      weights += weight;
    }
  }
  const float share = 1 / weights;
  return lightOf(sum * Four{share, share, share, share * share});
}

}  // namespace

void denoise(Picture& picture, const CameraRays& rays, int threads) { Filter(picture, rays, threads).run(); }

std::vector<Rgb> developed(const Picture& picture) {
  std::vector<Rgb> out;
  out.reserve(picture.texels.size());
  for (const Texel& texel : picture.texels) out.push_back(texel.direct + scaled(texel.colour, texel.sky));
  return out;
}

}  // namespace brickfall::render
