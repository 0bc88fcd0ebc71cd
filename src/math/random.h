// A small random generator of the same numbers everywhere (SplitMix64, Steele et al. 2014).
#pragma once
#include <cstdint>

namespace brickfall {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  // 0 <= r < 1
  double unit() { return double(bits() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  // 0 <= i < count, count > 0
  std::uint32_t below(std::uint32_t count) { return std::uint32_t((bits() >> 32) * count >> 32); }

 private:
  std::uint64_t state_;
};

}  // namespace brickfall
