#include "brickfall/result.h"

#include <gtest/gtest.h>

#include <memory>

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

TEST(Status, IsSuccessUnlessToldOtherwise) {
  EXPECT_TRUE(Status());
  Status bad = Error{ErrorCode::staleId, "body: found a destroyed body, expected a living one"};
  EXPECT_FALSE(bad);
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().code, ErrorCode::staleId);
}

}  // namespace
}  // namespace brickfall
