#include "math/random.h"

#include <gtest/gtest.h>

namespace brickfall {
namespace {

// SplitMix64's published first outputs from the seed 1234567.
TEST(Random, IsSplitMix64) {
  Random random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317ull);
  EXPECT_EQ(random.bits(), 3203168211198807973ull);
  EXPECT_EQ(random.bits(), 9817491932198370423ull);
  EXPECT_EQ(random.bits(), 4593380528125082431ull);
  EXPECT_EQ(random.bits(), 16408922859458223821ull);
}

TEST(Random, StaysInItsRangesAndFillsThem) {
  Random random(9);
  double sum = 0, least = 1, most = 0;
  int counts[7] = {};
  for (int k = 0; k < 70000; k++) {
    double u = random.unit();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    least = u < least ? u : least, most = u > most ? u : most;
    std::uint32_t i = random.below(7);
    ASSERT_LT(i, 7u);
    counts[i]++;
    double b = random.between(-3, -2);
    ASSERT_GE(b, -3);
    ASSERT_LE(b, -2);
  }
  EXPECT_NEAR(sum / 70000, 0.5, 0.005);
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(most, 1 - 1e-3);
  for (int count : counts) EXPECT_NEAR(count, 10000, 400);
}

}  // namespace
}  // namespace brickfall
