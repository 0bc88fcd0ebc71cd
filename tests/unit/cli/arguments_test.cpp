#include "cli/arguments.h"

#include <gtest/gtest.h>

namespace brickfall::cli {
namespace {

TEST(Arguments, secondsAreANumberAboveZero) {
  EXPECT_EQ(*parseSeconds("2.5"), 2.5);
  EXPECT_EQ(*parseSeconds("1e-3"), 1e-3);
  for (const char* bad : {"", "0", "-1", "nan", "-nan", "inf", "1e9", "abc", "1s", " 1", "1 ", "0x10", "1e999"}) {
    const Result<double> parsed = parseSeconds(bad);
    ASSERT_FALSE(parsed) << bad;
    EXPECT_NE(parsed.error().message.find("--seconds: found \"" + std::string(bad) + "\", expected"),
              std::string::npos);
  }
}

TEST(Arguments, threadsAreAWholeNumberInRange) {
  EXPECT_EQ(*parseThreads("1"), 1);
  EXPECT_EQ(*parseThreads("64"), 64);
  for (const char* bad : {"", "0", "-1", "65", "1.5", "99999999999999999999", "two", "nan"})
    EXPECT_FALSE(parseThreads(bad)) << bad;
}

TEST(Arguments, overridesSplitAtTheFirstEqualsSign) {
  const auto pair = parseOverride("world.title=a=b");
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->first, "world.title");
  EXPECT_EQ(pair->second, "a=b");
  EXPECT_EQ(parseOverride("key=")->second, "");
  for (const char* bad : {"", "=", "=1", "key"}) EXPECT_FALSE(parseOverride(bad)) << bad;
}

}  // namespace
}  // namespace brickfall::cli
