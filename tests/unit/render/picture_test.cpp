// Pictures of a small take against pictures kept here, the same from any number of threads; and PNG files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "render/denoise.h"
#include "render/job.h"
#include "render/moving_shade.h"
#include "render/painter.h"
#include "render/png_file.h"
#include "support/synthetic_take.h"

namespace brickfall::render {
namespace {

// A wall of twelve bricks, a ball, a capsule, a hull and a body of brick and steel; the ball has just come through.
class Pictures : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string path = testing::TempDir() + "brickfall_pictures_" + std::to_string(getpid()) + ".take";
    const test::SyntheticTake made =
        test::makeSyntheticTake({.courses = 4, .bricksPerCourse = 3, .frames = 40, .hitFrame = 20});
    ASSERT_EQ(test::writeTake(made, path), "");
    Result<TakeReader> opened = TakeReader::open(path);
    std::filesystem::remove(path);
    ASSERT_TRUE(opened);
    take_ = new TakeReader(std::move(opened).value());
  }
  static void TearDownTestSuite() {
    delete take_;
    take_ = nullptr;
  }

  static Image still(double time, int camera, int samples, int threads, double shutter = 1.0 / 50, bool smooth = true) {
    Result<Stage> stage = Stage::create(*take_);
    EXPECT_TRUE(stage);
    Motion motion(*take_);
    stage->place(*motion.between(time, time + shutter));
    PaintSettings settings;
    settings.width = 96;
    settings.height = 54;
    settings.denoise = smooth;
    settings.trace.samples = samples;
    settings.trace.threads = threads;
    const Camera view = viewOf(camera);
    return paint(*stage, cameraAt(view, time), cameraAt(view, time + shutter), skyFor(view, {}), settings);
  }
  // Near enough that most of the picture is bricks.
  static Camera viewOf(int camera) {
    Camera view = take_->header().cameras[std::size_t(camera)];
    view.path.clear();
    view.position = camera == 0 ? Vec3{0.4, 0.45, 0.95} : Vec3{-0.9, 0.3, 0.4};
    view.target = {0, 0.12, 0.05};
    return view;
  }
  static TakeReader* take_;
};
TakeReader* Pictures::take_ = nullptr;

// Mean difference of all bytes, in steps of 8 bits.
double difference(const Image& a, const Image& b) {
  if (a.bytes.size() != b.bytes.size() || a.bytes.empty()) return 255;
  double sum = 0;
  for (std::size_t k = 0; k < a.bytes.size(); k++) sum += std::abs(int(a.bytes[k]) - int(b.bytes[k]));
  return sum / double(a.bytes.size());
}

// Written anew by BRICKFALL_WRITE_REFERENCE=1, after a change of how things look was meant.
TEST_F(Pictures, LookLikeThoseKept) {
  const std::string folder = BRICKFALL_SOURCE_DIR "/tests/unit/render/reference/";
  const struct {
    const char* name;
    double time;
    int camera;
  } stills[] = {{"before", 0, 0}, {"hit", 0.38, 0}, {"side", 0.5, 1}};
  for (const auto& one : stills) {
    const Image image = still(one.time, one.camera, 16, 2);
    const std::string path = folder + one.name + ".png";
    if (std::getenv("BRICKFALL_WRITE_REFERENCE")) {
      ASSERT_TRUE(writePng(path, image));
    }
    const Result<Image> kept = readPng(path);
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_LT(difference(image, *kept), 0.5) << one.name;
  }
  // What that tolerance sees: another moment, another camera.
  EXPECT_GT(difference(still(0, 0, 16, 2), still(0.38, 0, 16, 2)), 2.0);
  EXPECT_GT(difference(still(0, 0, 16, 2), still(0, 1, 16, 2)), 2.0);
}

TEST_F(Pictures, AreTheSameFromAnyNumberOfThreads) {
  const Image one = still(0.38, 0, 4, 1);
  for (int threads : {2, 3}) EXPECT_EQ(still(0.38, 0, 4, threads).bytes, one.bytes) << threads;
}

TEST_F(Pictures, DoNotDependOnThoseBefore) {
  Result<Stage> stage = Stage::create(*take_);
  ASSERT_TRUE(stage);
  Motion motion(*take_);
  PaintSettings settings;
  settings.width = 96;
  settings.height = 54;
  const Camera view = viewOf(0);
  for (double time : {0.0, 0.3, 0.36}) {
    stage->place(*motion.between(time, time + 0.02));
    EXPECT_FALSE(paint(*stage, view, view, skyFor(view, {}), settings).bytes.empty());
  }
  EXPECT_TRUE(stage->place(*motion.between(0.38, 0.4)));
  EXPECT_FALSE(stage->place(*motion.between(0.38, 0.4))) << "all is where it was";
  EXPECT_EQ(paint(*stage, view, view, skyFor(view, {}), settings).bytes, still(0.38, 0, 4, 1, 0.02).bytes);
}

// One that is gone moves no more: or all pictures after it would be drawn as if something did, and those of a run that was gone on with
// would differ.
TEST(Stage, WhatIsGoneLeavesNoTrace) {
  const std::string path = testing::TempDir() + "brickfall_gone_" + std::to_string(getpid()) + ".take";
  const test::SyntheticTake made =
      test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 95, .hitFrame = 4, .breaking = true});
  ASSERT_EQ(test::writeTake(made, path), "");
  const Result<TakeReader> take = TakeReader::open(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(take);
  Motion motion(*take);
  std::uint32_t gone = 0;
  while (made.bodies[gone].name != "piece 1") gone++;
  const std::size_t last = take->lives()[gone].end - 1;
  const auto timeOf = [&](std::size_t frame) { return made.frames[frame].time; };
  Result<Stage> travelled = Stage::create(*take), fresh = Stage::create(*take);
  ASSERT_TRUE(travelled && fresh);
  const auto partOf = [&](const Stage& stage) {
    return *std::find_if(stage.parts().begin(), stage.parts().end(), [&](const Part& p) { return p.body == gone; });
  };
  std::size_t moving = take->lives()[gone].birth;  // a frame from which on it moves
  for (; moving < last; moving++) {
    travelled->place(*motion.between(timeOf(moving), timeOf(moving + 1)));
    if (partOf(*travelled).moves) break;
  }
  ASSERT_LT(moving, last);
  const Motion::Shutter after = *motion.between(timeOf(94), timeOf(94));
  ASSERT_FALSE(after.open.there[gone]);
  EXPECT_TRUE(travelled->place(after));
  fresh->place(after);
  EXPECT_FALSE(partOf(*travelled).moves);
  EXPECT_EQ(partOf(*travelled).sweep, 0);
  PaintSettings settings;
  settings.width = 96;
  settings.height = 54;
  Camera view;
  view.position = {0.4, 0.45, 0.95};
  view.target = {0, 0.12, 0.05};
  const Sky sky = skyFor(view, {});
  EXPECT_EQ(paint(*travelled, view, view, sky, settings).bytes, paint(*fresh, view, view, sky, settings).bytes);
}

TEST_F(Pictures, ShadowsMoveDownSunOfWhatMovesAlone) {
  Result<Stage> stage = Stage::create(*take_);
  ASSERT_TRUE(stage);
  Motion motion(*take_);
  Sky sky;
  sky.sun = appearance::sunDirection(90, 45);
  stage->place(*motion.between(0.3, 0.3));  // a shutter that is open for no time
  EXPECT_FALSE(MovingShade(*stage, sky, false).anyMotion());
  EXPECT_TRUE(MovingShade(*stage, sky, true).reaches({}, 1));
  stage->place(*motion.between(0.1, 0.12));  // only the ball flies
  const MovingShade shade(*stage, sky, false);
  ASSERT_TRUE(shade.anyMotion());
  const auto ball = std::max_element(stage->parts().begin(), stage->parts().end(),
                                     [](const Part& a, const Part& b) { return a.sweep < b.sweep; });
  ASSERT_GT(ball->sweep, 0.01f);
  EXPECT_TRUE(shade.reaches(ball->origin, 0.001f));
  EXPECT_TRUE(shade.reaches(ball->origin - sky.sun * 2.0f, 0.001f)) << "where its shadow falls";
  EXPECT_FALSE(shade.reaches(ball->origin + sky.sun * 2.0f, 0.001f)) << "between it and the sun";
  EXPECT_FALSE(shade.reaches(ball->origin - sky.sun * 2.0f + Vec3f{0, 0, 5}, 0.001f)) << "beside it";
  EXPECT_FALSE(shade.reaches(ball->origin, 10)) << "seen from so far away nothing moves";
}

TEST_F(Pictures, MotionIsBlurredByTheShutter) {
  EXPECT_GT(difference(still(0.25, 0, 16, 2, 0.05), still(0.25, 0, 16, 2, 0)), 0.2);
  EXPECT_EQ(still(0, 0, 4, 2, 0).bytes, still(0, 0, 4, 2, 0).bytes);
}

// The filter brings a picture of few samples nearer to that of many, and leaves that of many nearly as it is.
TEST_F(Pictures, FilterTakesNoiseOut) {
  const Image many = still(0, 0, 256, 2, 0, false);
  EXPECT_LT(difference(still(0, 0, 4, 2, 0, true), many), 0.75 * difference(still(0, 0, 4, 2, 0, false), many));
  EXPECT_LT(difference(still(0, 0, 256, 2, 0, true), many), 0.6);
}

TEST(PngFile, ComesBackAsWritten) {
  const std::string path = testing::TempDir() + "brickfall_png_" + std::to_string(getpid()) + ".png";
  Image image{5, 3, {}};
  for (int k = 0; k < 45; k++) image.bytes.push_back(std::uint8_t(k * 5));
  ASSERT_TRUE(writePng(path, image));
  const Result<Image> back = readPng(path);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->width, 5);
  EXPECT_EQ(back->height, 3);
  EXPECT_EQ(back->bytes, image.bytes);
  std::ofstream(path, std::ios::binary) << "no picture";
  EXPECT_FALSE(readPng(path));
  std::filesystem::remove(path);
  EXPECT_EQ(readPng(path).error().code, ErrorCode::inputOutput);
  EXPECT_FALSE(writePng("/nowhere/at/all.png", image));
}

TEST_F(Pictures, DustRisesWhereBodiesHitInTheColourOfWhatBroke) {
  const Dust dust(*take_);
  const double hit = 20.0 / 60;
  EXPECT_TRUE(dust.at(hit - 0.04).empty());
  EXPECT_TRUE(dust.at(hit + 2).empty());
  const std::vector<Puff> puffs = dust.at(hit + 0.1);
  ASSERT_FALSE(puffs.empty());
  EXPECT_GT(puffs[0].colour.x, 1.15f * puffs[0].colour.z);  // of brick, not of the ball's steel
  Camera camera;
  camera.target = {double(puffs[0].place.x), double(puffs[0].place.y), double(puffs[0].place.z)};
  camera.position = camera.target + Vec3{0, 0, 2};
  Picture picture{64, 64, std::vector<Texel>(64 * 64)};
  const auto changed = [&](float depth, int threads) {
    for (Texel& texel : picture.texels) texel.depth = depth;
    std::vector<Rgb> light(64 * 64);
    addDust(light, picture, render::viewOf(camera), puffs, threads);
    return light;
  };
  const std::vector<Rgb> open = changed(1e4f, 1), again = changed(1e4f, 3), behind = changed(0.5f, 1);
  EXPECT_TRUE(
      std::equal(open.begin(), open.end(), again.begin(), [](Rgb a, Rgb b) { return a.x == b.x && a.z == b.z; }));
  const auto brightest = [](const std::vector<Rgb>& light) {
    return std::max_element(light.begin(), light.end(), [](Rgb a, Rgb b) { return a.x < b.x; })->x;
  };
  EXPECT_GT(brightest(open), 0.05f);
  EXPECT_LT(brightest(open), 1.5f);
  EXPECT_EQ(brightest(behind), 0);
}

}  // namespace
}  // namespace brickfall::render
