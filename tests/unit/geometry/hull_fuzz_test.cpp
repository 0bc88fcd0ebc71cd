// A bounded, deterministic run of the fuzz target (tests/fuzz/hull_fuzz.cpp), which ends the program on a fault.
#include <gtest/gtest.h>

#include "support/random_geometry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace brickfall {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes randomBytes(Random& random, std::size_t size) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = std::uint8_t(random.bits());
  return bytes;
}

TEST(HullFuzz, RandomBytes) {
  Random random(1);
  for (int round = 0; round < 8000; round++) {
    Bytes bytes = randomBytes(random, random.below(round % 10 == 0 ? 1200 : 200));
    ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0) << round;
  }
}

// Few distinct coordinates make doubled points, common lines and planes; copied stretches make repeats.
TEST(HullFuzz, RepeatsAndCommonPlanes) {
  Random random(2);
  for (int round = 0; round < 8000; round++) {
    Bytes bytes = randomBytes(random, 2 + 3 * random.below(80));
    int values = 1 + int(random.below(4));
    for (std::size_t k = 2; k < bytes.size(); k++) bytes[k] = std::uint8_t(bytes[k] % values * (k % 2 ? 1 : 5));
    bytes[0] = std::uint8_t(2 + round % 2);
    for (std::size_t k = 20; k < bytes.size() && round % 3 == 0; k++) bytes[k] = bytes[k - 18];
    ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0) << round;
  }
}

// Floats with a common exponent are plausible solids; single bits flipped in them are not.
TEST(HullFuzz, FloatsWithFlippedBits) {
  Random random(3);
  for (int round = 0; round < 8000; round++) {
    Bytes bytes = randomBytes(random, 2 + 12 * (4 + random.below(30)));
    bytes[0] = 1;
    for (std::size_t k = 2; k + 3 < bytes.size(); k += 4) {
      bytes[k + 3] = std::uint8_t((bytes[k + 3] & 0x80) | 0x3f);
      bytes[k + 2] = std::uint8_t((round % 2 ? 0x80 : bytes[k + 2]) | 0x80);
    }
    if (round % 3 == 0) bytes[2 + random.below(std::uint32_t(bytes.size() - 2))] ^= std::uint8_t(1 << random.below(8));
    ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0) << round;
  }
}

}  // namespace
}  // namespace brickfall
