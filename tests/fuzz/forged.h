// Changes to the bytes of something real, as libFuzzer's input spells them, and its checksum made right again: what a file
// looks like that means harm.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "base/hash.h"
#include "fuzz/fuzz_check.h"

namespace brickfall::fuzz {

inline constexpr double kDoubles[] = {0.0,
                                      -0.0,
                                      1,
                                      -1,
                                      0.5,
                                      1e-300,
                                      1e-30,
                                      1e10,
                                      1e30,
                                      1e300,
                                      std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::quiet_NaN()};
inline constexpr std::uint32_t kWords[] = {0, 1, 2, 3, 4, 5, 7, 8, 16, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};

struct Change {
  std::uint8_t kind, value, at[3], from[3];
};

inline std::size_t placeOf(const std::uint8_t (&at)[3], std::size_t size) {
  return (at[0] | std::size_t(at[1]) << 8 | std::size_t(at[2]) << 16) % size;
}

inline void put(std::vector<std::byte>& bytes, std::size_t at, const void* data, std::size_t size) {
  size = std::min(size, bytes.size() - at);
  std::memcpy(bytes.data() + at, data, size);
}

inline void applyChange(const Change& c, std::vector<std::byte>& bytes) {
  if (bytes.empty()) return;
  std::size_t at = placeOf(c.at, bytes.size()), from = placeOf(c.from, bytes.size());
  double d = kDoubles[c.value % std::size(kDoubles)];
  float f = float(d);
  std::uint32_t word = kWords[c.value % std::size(kWords)];
  std::size_t length = std::min<std::size_t>(c.value, bytes.size() - std::max(at, from));
  auto here = bytes.begin() + std::ptrdiff_t(at);
  switch (c.kind % 9) {
    case 0:
      bytes[at] = std::byte(c.value);
      break;
    case 1:
      bytes[at] ^= std::byte(c.value);
      break;
    case 2:
      put(bytes, at, &d, sizeof d);
      break;
    case 3:
      put(bytes, at, &f, sizeof f);
      break;
    case 4:
      put(bytes, at, &word, sizeof word);
      break;
    case 5:
      std::memmove(&bytes[at], &bytes[from], length);
      break;
    case 6:
      bytes.insert(here, c.value, std::byte(c.from[0]));
      break;
    case 7:
      bytes.erase(here, here + std::ptrdiff_t(length));
      break;
    default:
      std::swap(bytes[at], bytes[from]);
  }
}

// The hash at `hashAt` becomes that of all bytes from `from` on.
inline void seal(std::vector<std::byte>& bytes, std::size_t hashAt, std::size_t from) {
  if (bytes.size() < from) return;
  Hash hash;
  for (std::size_t i = from; i < bytes.size(); i++) hash.addByte(std::uint8_t(bytes[i]));
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + hashAt, &value, sizeof value);
}

}  // namespace brickfall::fuzz
