#include "cli/statistics.h"

#include <gtest/gtest.h>

namespace brickfall::cli {
namespace {

TEST(Statistics, nothingMeasuredIsZero) {
  const Distribution d = distributionOf({});
  EXPECT_EQ(d.mean, 0);
  EXPECT_EQ(d.max, 0);
}

TEST(Statistics, oneValueIsAll) {
  const Distribution d = distributionOf({3});
  EXPECT_EQ(d.mean, 3);
  EXPECT_EQ(d.median, 3);
  EXPECT_EQ(d.p95, 3);
  EXPECT_EQ(d.max, 3);
}

TEST(Statistics, percentilesAreNearestRanksOfTheSortedValues) {
  std::vector<double> values;
  for (int i = 100; i >= 1; i--) values.push_back(i);
  const Distribution d = distributionOf(values);
  EXPECT_DOUBLE_EQ(d.mean, 50.5);
  EXPECT_EQ(d.median, 50);
  EXPECT_EQ(d.p95, 95);
  EXPECT_EQ(d.max, 100);
}

}  // namespace
}  // namespace brickfall::cli
