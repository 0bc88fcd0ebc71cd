// FNV-1a over the bits of values: equal hashes mean bit-identical states. -0.0 counts as 0.0.
#pragma once
#include <bit>
#include <cstdint>

namespace brickfall {

class Hash {
 public:
  void addByte(std::uint8_t byte) { value_ = (value_ ^ byte) * 1099511628211ull; }
  void add(std::uint64_t bits) {
    for (int k = 0; k < 8; k++) addByte(std::uint8_t(bits >> (8 * k)));
  }
  void add(double value) { add(value == 0 ? std::uint64_t(0) : std::bit_cast<std::uint64_t>(value)); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace brickfall
