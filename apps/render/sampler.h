// Random numbers without a state: each follows from pixel, sample and purpose alone, so that a picture is the same whatever thread
// draws which part of it. The points of one pixel are spread evenly (a Sobol sequence, scrambled by Owen's nested flips in the
// form of a hash), and so are those of neighbouring pixels together: they are taken in the order of a Z-shaped curve through
// the picture. Noise is then of a kind that a filter of some pixels takes out.
#pragma once
#include <cstdint>

namespace brickfall::render {

struct Pair {
  float x = 0, y = 0;  // 0 <= v < 1
};

inline std::uint32_t reversedBits(std::uint32_t v) {
  v = (v >> 1 & 0x55555555u) | (v & 0x55555555u) << 1;
  v = (v >> 2 & 0x33333333u) | (v & 0x33333333u) << 2;
  v = (v >> 4 & 0x0f0f0f0fu) | (v & 0x0f0f0f0fu) << 4;
  return __builtin_bswap32(v);
}
// Flips each bit depending on those below it only (the factors are even). Of reversed bits it is Owen's scrambling.
inline std::uint32_t flippedUpwards(std::uint32_t v, std::uint32_t seed) {
  v += seed;
  v ^= v * 0x5b0f2d94u;
  v ^= v * 0xa34e91c6u;
  v ^= v * 0xe1d75a2cu;
  v ^= v * 0x7cb3a48au;
  return v;
}
// The bits of x and y in turn.
inline std::uint32_t zOrder(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint32_t v) {
    v &= 0xffffu;
    v = (v | v << 8) & 0x00ff00ffu;
    v = (v | v << 4) & 0x0f0f0f0fu;
    v = (v | v << 2) & 0x33333333u;
    return (v | v << 1) & 0x55555555u;
  };
  return spread(x) | spread(y) << 1;
}

class Sampler {
 public:
  // `samples`: the most that a pixel takes, those for motion included.
  Sampler(int x, int y, int samples) : first_(zOrder(std::uint32_t(x), std::uint32_t(y)) * std::uint32_t(samples)) {}

  // The pair of numbers for a purpose (0, 1, 2 ...) of a sample.
  Pair pair(int sample, int purpose) const {
    const std::uint32_t seed = (std::uint32_t(purpose) + 1) * 0x9e3779b9u;
    // Another order for each purpose, or two purposes would always get the same pairs together.
    const std::uint32_t index =
        reversedBits(flippedUpwards(reversedBits(first_ + std::uint32_t(sample)), seed ^ 0x68bc21ebu));
    // The first Sobol number is the index with its bits reversed; the matrix of the second is Pascal's triangle, odd or even.
    std::uint32_t second = index;
    second ^= (second & 0xaaaaaaaau) >> 1;
    second ^= (second & 0xccccccccu) >> 2;
    second ^= (second & 0xf0f0f0f0u) >> 4;
    second ^= (second & 0xff00ff00u) >> 8;
    second ^= second >> 16;
    return {unit(reversedBits(flippedUpwards(index, seed ^ 0x02e5be93u))),
            unit(reversedBits(flippedUpwards(second, seed ^ 0x967a889bu)))};
  }

 private:
  static float unit(std::uint32_t v) { return float(v >> 8) * 0x1p-24f; }
  std::uint32_t first_;
};

}  // namespace brickfall::render
