#include "viewer_window/options.h"

#include <gtest/gtest.h>

namespace brickfall::viewer {
namespace {

TEST(ViewerOptions, sizesArePixelsByPixels) {
  const Result<WindowSize> size = parseSize("800x600");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 800);
  EXPECT_EQ(size->height, 600);
  for (const char* wrong : {"", "800", "x", "800x", "x600", "800x600x", "8e2x600", "319x200", "320x199", "9000x600",
                            "-800x600", " 800x600"}) {
    const Result<WindowSize> refused = parseSize(wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_NE(refused.error().message.find("--size: found '" + std::string(wrong) + "'"), std::string::npos);
    EXPECT_NE(refused.error().message.find("1280x720"), std::string::npos);
  }
}

TEST(ViewerOptions, shadowsByTheirNames) {
  for (int i = 0; i < kShadowChoiceCount; i++) {
    const Result<ShadowChoice> choice = parseShadows(nameOf(ShadowChoice(i)));
    ASSERT_TRUE(choice);
    EXPECT_EQ(int(*choice), i);
  }
  const Result<ShadowChoice> refused = parseShadows("dept");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("did you mean \"depth\"?"), std::string::npos) << refused.error().message;
}

TEST(ViewerOptions, numbersAreWholeTexts) {
  EXPECT_EQ(*parseSamples("4"), 4);
  EXPECT_EQ(*parseTime("2.5"), 2.5);
  EXPECT_EQ(*parseFrames("100"), 100u);
  for (const char* wrong : {"", "1", "3", "16", "4x", "-4"}) EXPECT_FALSE(parseSamples(wrong)) << wrong;
  for (const char* wrong : {"", "0", "-1", "nan", "inf", "2s", "1e9"}) EXPECT_FALSE(parseTime(wrong)) << wrong;
  for (const char* wrong : {"", "0", "-1", "1.5", "99999999999999999999"}) EXPECT_FALSE(parseFrames(wrong)) << wrong;
}

}  // namespace
}  // namespace brickfall::viewer
