#include "render/denoise.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "render/parallel.h"

namespace brickfall::render {

namespace {

using appearance::brightness;

constexpr int kRounds = 4;        // neighbours 1, 2, 4 and 8 pixels away: a mean over some 30 x 30
constexpr float kLightRange = 3;  // standard deviations of noise that two neighbours may differ by; more blurs shade
// Of the spread among neighbours that counts as noise: more blurs where shade ends, less leaves specks.
constexpr float kAroundShare = 2;
constexpr int kUnsureRounds = 2;  // so many rounds what a pixel says of its own noise is not believed
constexpr float kLeastRange =
    0.04f;  // share of its light that may always differ: less keeps grains of pixels that are sure and wrong
constexpr float kPlaneRange = 2;  // pixels' widths that a neighbour may lie off the surface

// Four pixels beside each other.
using Four = float __attribute__((vector_size(16)));
Four load(const float* from) {
  Four v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
void store(float* to, Four v) { std::memcpy(to, &v, sizeof v); }
Four larger(Four a, Four b) { return a > b ? a : b; }
Four root(Four v) { return Four{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])}; }

constexpr int kLanes = 4;
constexpr int kMargin =
    1 << (kRounds - 1);  // as far as neighbours reach; what lies there is not covered and counts nothing

enum Plane { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kWidth, kCovered, kGuidePlanes };
enum LightPlane { kRed, kGreen, kBlue, kVariance, kBrightness, kLightPlanes };

class Filter {
 public:
  Filter(Picture& picture, const CameraRays& rays, int threads)
      : picture_(picture),
        threads_(threads),
        stride_(std::size_t((picture.width + kLanes - 1) / kLanes * kLanes + 2 * kMargin)),
        size_(stride_ * std::size_t(picture.height + 2 * kMargin)),
        guides_(kGuidePlanes * size_),
        from_(kLightPlanes * size_),
        to_(from_.size()) {
    forRows(picture.height, threads, [&](int y) {
      for (int x = 0; x < picture.width; x++) take(x, y, rays);
    });
  }

  void run() {
    for (int round = 0; round < kRounds; round++) {
      forRows(picture_.height, threads_, [&](int y) {
        for (int x = 0; x < picture_.width; x += kLanes) mean(index(x, y), std::ptrdiff_t(1) << round);
      });
      std::swap(from_, to_);
    }
    for (int y = 0; y < picture_.height; y++)
      for (int x = 0; x < picture_.width; x++) {
        const std::size_t k = index(x, y);
        picture_.at(x, y).sky = {*light(kRed, k), *light(kGreen, k), *light(kBlue, k)};
      }
  }

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y + kMargin) * stride_ + std::size_t(x) + std::size_t(kMargin);
  }
  const float* guide(Plane plane, std::size_t k) const { return &guides_[plane * size_ + k]; }
  const float* light(LightPlane plane, std::size_t k) const { return &from_[plane * size_ + k]; }
  void take(int x, int y, const CameraRays& rays);
  Four smoothVariance(std::size_t here) const;
  void mean(std::size_t here, std::ptrdiff_t step);

  Picture& picture_;
  int threads_;
  std::size_t stride_, size_;  // of a row, of a plane, with the margin
  std::vector<float> guides_, from_, to_;
};

void Filter::take(int x, int y, const CameraRays& rays) {
  const Texel& texel = picture_.at(x, y);
  const Ray ray = rays.through(float(x) + 0.5f, float(y) + 0.5f, 0.5f);
  const Vec3f position = ray.origin + ray.direction * texel.depth, normal = texel.normal;
  const float guide[kGuidePlanes] = {
      position.x, position.y, position.z, normal.x, normal.y, normal.z, texel.depth * rays.pixelAngle(), texel.covered};
  const float light[kLightPlanes] = {texel.sky.x, texel.sky.y, texel.sky.z, texel.variance, brightness(texel.sky)};
  const std::size_t k = index(x, y);
  for (std::size_t plane = 0; plane < kGuidePlanes; plane++) guides_[plane * size_ + k] = guide[plane];
  for (std::size_t plane = 0; plane < kLightPlanes; plane++) from_[plane * size_ + k] = light[plane];
}

constexpr float kWeights[2] = {0.5f, 0.25f};  // by distance, along each axis

// That of one pixel, from few samples, is itself little to be trusted. After some rounds it is a mean anyway.
// Pixels that are sure and wrong, since both of their samples met the same, are found by how much they differ from those around them.
Four Filter::smoothVariance(std::size_t here) const {
  Four variance{}, light_{}, squares{}, weights{};
  for (int j = -1; j <= 1; j++)
    for (int i = -1; i <= 1; i++) {
      const std::size_t k = here + std::size_t(j * std::ptrdiff_t(stride_) + i);
      const Four weight = kWeights[std::abs(i)] * kWeights[std::abs(j)] * load(guide(kCovered, k));
      const Four bright = load(light(kBrightness, k));
      variance += weight * load(light(kVariance, k));
      light_ += weight * bright;
      squares += weight * bright * bright;
      weights += weight;
    }
  const Four share = 1 / larger(weights, Four{} + 1e-9f), mean = light_ * share;
  return larger(variance * share, kAroundShare * (squares * share - mean * mean));
}

void Filter::mean(std::size_t here, std::ptrdiff_t step) {
  const auto own = [&](Plane plane) { return load(guide(plane, here)); };
  const Four x = own(kX), y = own(kY), z = own(kZ), nx = own(kNormalX), ny = own(kNormalY), nz = own(kNormalZ);
  const Four covered = own(kCovered), bright = load(light(kBrightness, here));
  const Four deviation = root(step < 1 << kUnsureRounds ? smoothVariance(here) : load(light(kVariance, here)));
  const Four range = 1 / (kLightRange * deviation + kLeastRange * bright + 1e-4f);
  const Four plane = 1 / (kPlaneRange * own(kWidth) + 1e-5f);
  Four weights = kWeights[0] * kWeights[0] * covered, sums[kVariance + 1];
  for (int k = 0; k < kVariance; k++) sums[k] = weights * load(light(LightPlane(k), here));
  sums[kVariance] = weights * weights * load(light(kVariance, here));
  for (int j = -1; j <= 1; j++)
    for (int i = -1; i <= 1; i++) {
      if (i == 0 && j == 0) continue;
      const std::size_t at = here + std::size_t(step * (j * std::ptrdiff_t(stride_) + i));
      const auto its = [&](Plane p) { return load(guide(p, at)); };
      const Four turned = larger(nx * its(kNormalX) + ny * its(kNormalY) + nz * its(kNormalZ), Four{});
      const Four t2 = turned * turned, t4 = t2 * t2, t8 = t4 * t4;
      const Four off = (nx * (its(kX) - x) + ny * (its(kY) - y) + nz * (its(kZ) - z)) * plane, off2 = off * off;
      const Four apart = (load(light(kBrightness, at)) - bright) * range, apart2 = apart * apart;
      const Four weight = kWeights[std::abs(i)] * kWeights[std::abs(j)] * its(kCovered) * t8 * t8 /
                          ((1 + off2 * off2) * (1 + apart2 * apart2));
      for (int k = 0; k < kVariance; k++) sums[k] += weight * load(light(LightPlane(k), at));
      sums[kVariance] += weight * weight * load(light(kVariance, at));
      weights += weight;
    }
  const Four share = 1 / larger(weights, Four{} + 1e-9f);
  sums[kVariance] *= share;
  for (int k = 0; k <= kVariance; k++) {  // what is not covered stays as it is
    const Four result = covered > 0 ? sums[k] * share : load(light(LightPlane(k), here));
    sums[k] = result;
    store(&to_[std::size_t(k) * size_ + here], result);
  }
  store(&to_[kBrightness * size_ + here], 0.2126f * sums[kRed] + 0.7152f * sums[kGreen] + 0.0722f * sums[kBlue]);
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
