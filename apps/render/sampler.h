// Random numbers without a state: each follows from pixel, sample and purpose alone, so that a picture is the same whatever thread
// draws which part of it. The points of one pixel are spread evenly (a Sobol sequence, scrambled by Owen's nested flips in the
// form of a hash), and so are those that every pixel takes, of neighbouring pixels together: they are taken in the order of a Z-shaped
// curve through the picture. Noise is then of a kind that a filter of some pixels takes out.
#pragma once
#include <bit>
#include <cstdint>

#include "appearance/noise.h"

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
// Flips each bit depending on those below it only (the factors of what is flipped in are even). Of reversed bits it is Owen's scrambling.
inline std::uint32_t flippedUpwards(std::uint32_t v, std::uint32_t seed) {
  v ^= v * 0x5b0f2d94u;
  v += seed;
  v *= seed >> 15 | 1;
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
  // `all`: samples that every pixel takes; `most`: those that one may take.
  Sampler(int x, int y, int all, int most)
      : all_(std::bit_ceil(std::uint32_t(all))),
        first_(zOrder(std::uint32_t(x), std::uint32_t(y)) * all_),
        ownBits_(std::bit_width(std::uint32_t(most) - 1)) {}

  // The pair of numbers for a purpose (0, 1, 2 ...) of a sample.
  Pair pair(int sample, int purpose) const {
    const std::uint32_t seed = (std::uint32_t(purpose) + 1) * 0x9e3779b9u;
    // Another order for each purpose, or two purposes would always get the same pairs together.
    // A pixel's further samples fill up the block of the sequence that its first lie in, so that all are evenly spread. Neighbours fill
    // up the same block: each in an order of its own, which keeps 4, 8, 16 ... of them even, and elsewhere within the cells, or they would
    // all be wrong by the same.
    std::uint32_t at = std::uint32_t(sample);
    const bool further = at >= all_;
    const std::uint32_t own = further ? appearance::hashOf(std::uint64_t(first_) << 32 | seed) : 0;
    if (further) at ^= own & (std::bit_floor(at) - 1);
    const std::uint32_t index = reversedBits(flippedUpwards(reversedBits(first_ ^ at), seed ^ 0x68bc21ebu));
    // The first Sobol number is the index with its bits reversed; the matrix of the second is Pascal's triangle, odd or even.
    std::uint32_t second = index;
    second ^= (second & 0xaaaaaaaau) >> 1;
    second ^= (second & 0xccccccccu) >> 2;
    second ^= (second & 0xf0f0f0f0u) >> 4;
    second ^= (second & 0xff00ff00u) >> 8;
    second ^= second >> 16;
    std::uint32_t x = reversedBits(flippedUpwards(index, seed ^ 0x02e5be93u)),
                  y = reversedBits(flippedUpwards(second, seed ^ 0x967a889bu));
    if (further) {
      x ^= own >> ownBits_;
      y ^= own * 0xc2b2ae3du >> ownBits_;
    }
    return {unit(x), unit(y)};
  }

 private:
  static float unit(std::uint32_t v) { return float(v >> 8) * 0x1p-24f; }
  std::uint32_t all_, first_;
  int ownBits_;
};

}  // namespace brickfall::render
