// Where bodies are between the frames of a take.
#include "render/motion.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "support/synthetic_take.h"

namespace brickfall::render {
namespace {

struct RecordedTake {
  std::string path = testing::TempDir() + "brickfall_motion_" + std::to_string(getpid()) + ".take";
  explicit RecordedTake(const test::SyntheticTake& take) { EXPECT_EQ(test::writeTake(take, path), ""); }
  ~RecordedTake() { std::filesystem::remove(path); }
};

TEST(Motion, BodiesMoveFromFrameToFrame) {
  const test::SyntheticTake made = test::makeSyntheticTake({.courses = 2, .bricksPerCourse = 2, .frames = 90});
  const RecordedTake file(made);
  const Result<TakeReader> take = TakeReader::open(file.path);
  ASSERT_TRUE(take);
  Motion motion(*take);
  EXPECT_NEAR(*motion.timeOf(30), 0.5, 1e-9);
  for (std::size_t frame : {0, 30, 62, 89}) {
    const Result<Instant> at = motion.at(made.frames[frame].time);
    ASSERT_TRUE(at) << at.error().message;
    for (std::size_t k = 0; k < made.bodies.size(); k++) {
      EXPECT_TRUE(at->there[k]);
      EXPECT_LE(length(at->poses[k].position - made.frames[frame].poses[k].position), 1e-4) << frame << " " << k;
    }
  }
  // Half way between two frames: half way along, a whole quaternion.
  const Result<Instant> between = motion.at((made.frames[62].time + made.frames[63].time) / 2);
  ASSERT_TRUE(between);
  for (std::size_t k = 0; k < made.bodies.size(); k++) {
    const Vec3 middle = (made.frames[62].poses[k].position + made.frames[63].poses[k].position) * 0.5;
    EXPECT_LE(length(between->poses[k].position - middle), 1e-4);
    const Quat q = between->poses[k].rotation;
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-12);
  }
  EXPECT_EQ(motion.at(-5)->poses[2].position, motion.at(0)->poses[2].position);
  EXPECT_EQ(motion.at(99)->poses[2].position, motion.at(made.frames[89].time)->poses[2].position);
}

// Recorded from the middle of a run on.
TEST(Motion, FirstFrameMayBeLate) {
  test::SyntheticTake made = test::makeSyntheticTake({.courses = 2, .bricksPerCourse = 2, .frames = 90});
  for (TakeFrame& frame : made.frames) frame.time += 100;
  const RecordedTake file(made);
  const Result<TakeReader> take = TakeReader::open(file.path);
  ASSERT_TRUE(take);
  Motion motion(*take);
  for (std::size_t frame : {0, 62, 63, 89, 5}) {
    const Result<Instant> at = motion.at(made.frames[frame].time);
    ASSERT_TRUE(at);
    for (std::size_t k = 0; k < made.bodies.size(); k++)
      EXPECT_LE(length(at->poses[k].position - made.frames[frame].poses[k].position), 1e-4) << frame << " " << k;
  }
  EXPECT_EQ(motion.at(3)->poses[2].position, motion.at(100)->poses[2].position);
}

TEST(Motion, WhoIsThereIsToldByTheOpeningShutter) {
  const test::SyntheticTake made =
      test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 70, .hitFrame = 20, .breaking = true});
  const RecordedTake file(made);
  const Result<TakeReader> take = TakeReader::open(file.path);
  ASSERT_TRUE(take);
  Motion motion(*take);
  // "brick 0" (number 2) is there up to frame 19, its pieces come with frame 20.
  const Result<Motion::Shutter> shutter = motion.between(19.2 / 60, 20.4 / 60);
  ASSERT_TRUE(shutter);
  EXPECT_TRUE(shutter->open.there[2]);
  EXPECT_EQ(shutter->open.there, shutter->close.there);
  EXPECT_EQ(shutter->close.poses[2].position, shutter->open.poses[2].position);
  const std::size_t piece = made.bodies.size() - 1;
  EXPECT_FALSE(shutter->open.there[piece]);
  EXPECT_TRUE(motion.at(20.0 / 60)->there[piece]);
  EXPECT_FALSE(motion.at(20.0 / 60)->there[2]);
}

}  // namespace
}  // namespace brickfall::render
