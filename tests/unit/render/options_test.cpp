// Words of the command line to values, and what does not go together.
#include "render/options.h"

#include <gtest/gtest.h>

namespace brickfall::render {
namespace {

TEST(Options, ValuesAreReadWholeOrRefusedByName) {
  EXPECT_EQ(*parseNumber("--from", "1.5", 0, 10), 1.5);
  EXPECT_EQ(*parseCount("--samples", "16", 1, 100), 16);
  EXPECT_EQ(*parseSize("960x540"), std::pair(960, 540));
  EXPECT_EQ(parseSun("-40,35")->azimuthDegrees, -40);
  EXPECT_EQ(parseSun("-40,35")->elevationDegrees, 35);
  for (const char* wrong : {"", "1.5s", "nan", "inf", "-0.1", "10.1", "0x3", " 1"})
    EXPECT_EQ(parseNumber("--from", wrong, 0, 10).error().message,
              std::string("--from: found \"") + wrong + "\", expected a number 0 .. 10");
  for (const char* wrong : {"", "0", "101", "2.5", "many"})
    EXPECT_NE(parseCount("--samples", wrong, 1, 100).error().message.find("whole number 1 .. 100"), std::string::npos);
  for (const char* wrong :
       {"", "960", "x540", "960x", "960x540x2", "8x8", "5000x100", "9.5x100", "-960x540", "960*540"})
    EXPECT_NE(parseSize(wrong).error().message.find("--size: found"), std::string::npos) << wrong;
  for (const char* wrong : {"", "40", "40,", ",35", "40,0", "40,91", "400,35", "a,b"})
    EXPECT_NE(parseSun(wrong).error().message.find("--sun: found"), std::string::npos) << wrong;
}

TEST(Options, KindOfOutputComesFromItsName) {
  EXPECT_EQ(*outputKindOf("a/film.mp4"), OutputKind::film);
  EXPECT_EQ(*outputKindOf("still.png"), OutputKind::still);
  EXPECT_EQ(*outputKindOf("frames/"), OutputKind::folder);
  EXPECT_EQ(*outputKindOf(testing::TempDir()), OutputKind::folder);
  EXPECT_NE(outputKindOf("film.avi").error().message.find("--output: found \"film.avi\""), std::string::npos);
}

TEST(Options, WhatDoesNotGoTogetherIsRefused) {
  const auto fault = [](OutputKind kind, auto change) {
    RenderOptions options;
    options.output = "x";
    change(options);
    const Status status = checkTogether(options, kind);
    return status ? std::string() : status.error().message;
  };
  EXPECT_EQ(fault(OutputKind::film, [](RenderOptions&) {}), "");
  EXPECT_EQ(fault(OutputKind::still, [](RenderOptions& o) { o.frame = 3; }), "");
  EXPECT_EQ(fault(OutputKind::still, [](RenderOptions& o) { o.width = 961; }), "");
  EXPECT_NE(fault(OutputKind::film, [](RenderOptions& o) { o.width = 961; }).find("even numbers"), std::string::npos);
  EXPECT_NE(fault(OutputKind::film, [](RenderOptions& o) { o.frame = 3; }).find("--output"), std::string::npos);
  EXPECT_NE(fault(OutputKind::still, [](RenderOptions& o) { o.frame = 3, o.from = 1; }).find("--from"),
            std::string::npos);
  EXPECT_NE(fault(OutputKind::still, [](RenderOptions& o) { o.to = 1; }).find("--to"), std::string::npos);
  EXPECT_NE(fault(OutputKind::film, [](RenderOptions& o) { o.from = 2, o.to = 1; }).find("after --from, 2 s"),
            std::string::npos);
}

}  // namespace
}  // namespace brickfall::render
