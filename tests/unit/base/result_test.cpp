#include "brickfall/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <type_traits>

namespace brickfall {
namespace {

TEST(Result, HoldsAValueOrAnError) {
  Result<int> good = 7;
  EXPECT_TRUE(good);
  EXPECT_TRUE(good.ok());
  EXPECT_EQ(*good, 7);
  EXPECT_EQ(good.value(), 7);
  EXPECT_EQ(good.error().code, ErrorCode::none);
  Result<int> bad = Error{ErrorCode::badFormat, "line 3: found x, expected y"};
  EXPECT_FALSE(bad);
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().code, ErrorCode::badFormat);
  EXPECT_EQ(bad.error().message, "line 3: found x, expected y");
}

TEST(Result, AFalseValueIsStillAValue) {
  Result<bool> result = false;
  EXPECT_TRUE(result);
  EXPECT_FALSE(*result);
}

TEST(Result, GivesAwayWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  ASSERT_TRUE(result);
  std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 5);
}

using ResultDeathTest = testing::Test;
TEST(ResultDeathTest, ValueOfAnErrorEndsTheProgramWithItsMessage) {
  Result<int> bad = Error{ErrorCode::badFormat, "line 3: found x"};
  EXPECT_DEATH(bad.value(), "line 3: found x");
  EXPECT_DEATH((void)*bad, "line 3: found x");
  Result<std::string> text = Error{ErrorCode::badFormat, "no text"};
  EXPECT_DEATH((void)text->size(), "no text");
  EXPECT_DEATH((void)Result<int>(Error{ErrorCode::badFormat, "gone"}).value(), "gone");
}

TEST(ResultDeathTest, AHandlerIsToldFirst) {
  EXPECT_DEATH(
      {
        setFailureHandler([](const Failure& failure) { std::fprintf(stderr, "told: %s\n", failure.text); });
        (void)Result<int>(Error{ErrorCode::badFormat, "line 3"}).value();
      },
      "told: value of a failed result: line 3");
}

TEST(Result, OfATemporaryOutlivesIt) {
  const auto make = [] { return Result<std::string>(std::string("a text that is longer than its object")); };
  const std::string& text = make().value();
  const std::string& again = *make();
  EXPECT_EQ(text, again);
  static_assert(std::is_same_v<decltype(make().value()), std::string>);
}

TEST(Status, IsSuccessUnlessToldOtherwise) {
  EXPECT_TRUE(Status());
  Status bad = Error{ErrorCode::staleId, "body: found a destroyed body, expected a living one"};
  EXPECT_FALSE(bad);
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().code, ErrorCode::staleId);
}

}  // namespace
}  // namespace brickfall
