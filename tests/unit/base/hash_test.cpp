#include "base/hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace brickfall {
namespace {

template <class... Values> std::uint64_t hashOf(Values... values) {
  Hash hash;
  (hash.add(values), ...);
  return hash.value();
}

// Published test values of the 64-bit FNV-1a.
TEST(Hash, IsFnv1a) {
  EXPECT_EQ(Hash().value(), 0xcbf29ce484222325ull);
  Hash hash;
  for (char c : std::string("foobar")) hash.addByte(std::uint8_t(c));
  EXPECT_EQ(hash.value(), 0x85944171f73967e8ull);
}

TEST(Hash, SeesEveryBitAndTheOrder) {
  std::set<std::uint64_t> seen{hashOf(std::uint64_t(0))};
  for (int k = 0; k < 64; k++) seen.insert(hashOf(std::uint64_t(1) << k));
  EXPECT_EQ(seen.size(), 65u);
  EXPECT_NE(hashOf(1.0, 2.0), hashOf(2.0, 1.0));
  EXPECT_NE(hashOf(1.0), hashOf(std::nextafter(1.0, 2.0)));
  EXPECT_NE(hashOf(1.0), hashOf(-1.0));
}

TEST(Hash, BothZerosAreOne) {
  EXPECT_EQ(hashOf(0.0), hashOf(-0.0));
  EXPECT_NE(hashOf(0.0), hashOf(std::numeric_limits<double>::denorm_min()));
}

}  // namespace
}  // namespace brickfall
