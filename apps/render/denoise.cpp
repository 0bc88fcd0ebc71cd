#include "render/denoise.h"

#include <algorithm>
#include <cmath>

#include "render/parallel.h"

namespace brickfall::render {

namespace {

using appearance::brightness;

constexpr int kRounds = 4;        // neighbours 1, 2, 4 and 8 pixels away: a mean over some 30 x 30
constexpr float kLightRange = 3;  // standard deviations of noise that two neighbours may differ by; more blurs shade
constexpr float kPlaneRange = 2;  // pixels' widths that a neighbour may lie off the surface

struct Guide {
  Vec3f position, normal;
  float width = 0;  // m, of a pixel there
  float covered = 0;
};

struct Light {
  Rgb sky;
  float variance = 0, brightness = 0;
};

float falling(float x) { return 1 / (1 + x * x * x * x); }

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
        from_[index(x, y)] = {texel.sky, texel.variance, brightness(texel.sky)};
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
    for (std::size_t k = 0; k < from_.size(); k++) picture_.texels[k].sky = from_[k].sky;
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
float Filter::smoothVariance(int x, int y) const {
  float sum = 0, weights = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, picture_.height - 1); j++)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, picture_.width - 1); i++) {
      const std::size_t k = index(i, j);
      const float weight = kWeights[std::abs(i - x)] * kWeights[std::abs(j - y)] * guides_[k].covered;
      sum += weight * from_[k].variance;
      weights += weight;
    }
  return weights > 0 ? sum / weights : 0;
}

Light Filter::mean(int x, int y, int step) const {
  const std::size_t here = index(x, y);
  const Guide& guide = guides_[here];
  const Light& own = from_[here];
  if (guide.covered <= 0) return own;
  const float range = 1 / (kLightRange * std::sqrt(step == 1 ? smoothVariance(x, y) : own.variance) + 1e-4f);
  const float plane = 1 / (kPlaneRange * guide.width + 1e-5f);
  const float centre = kWeights[0] * kWeights[0] * guide.covered;
  Light sum{own.sky * centre, own.variance * centre * centre, 0};
  float weights = centre;
  for (int j = -1; j <= 1; j++)
    for (int i = -1; i <= 1; i++) {
      const int u = x + i * step, v = y + j * step;
      if ((i == 0 && j == 0) || u < 0 || v < 0 || u >= picture_.width || v >= picture_.height) continue;
      const std::size_t k = index(u, v);
      const Guide& other = guides_[k];
      if (other.covered <= 0) continue;
      const float turned = std::max(dot(guide.normal, other.normal), 0.0f), t2 = turned * turned,
                  t8 = t2 * t2 * t2 * t2;
      const float off = dot(guide.normal, other.position - guide.position) * plane;
      const float weight = kWeights[std::abs(i)] * kWeights[std::abs(j)] * other.covered * t8 * t8 * falling(off) *
                           falling((from_[k].brightness - own.brightness) * range);
      sum.sky += from_[k].sky * weight;
      sum.variance += from_[k].variance * weight * weight;
      weights += weight;
    }
  const Rgb sky = sum.sky * (1 / weights);
  return {sky, sum.variance / (weights * weights), brightness(sky)};
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
