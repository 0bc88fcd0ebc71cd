// What is decided before anything is drawn: cameras, moments, settings; and the folder of pictures.
#include "render/job.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "render/camera_move.h"
#include "render/frame_store.h"
#include "render/source.h"
#include "support/synthetic_take.h"

namespace brickfall::render {
namespace {

// `start`: s, of its first frame: later where recording began in the middle of a run.
TakeReader smallTake(bool cameras, double start = 0) {
  const std::string path = testing::TempDir() + "brickfall_job_" + std::to_string(getpid()) + ".take";
  test::SyntheticTake made = test::makeSyntheticTake({.courses = 2, .bricksPerCourse = 2, .frames = 61});
  if (!cameras) made.header.cameras.clear();
  for (TakeFrame& frame : made.frames) frame.time += start;
  EXPECT_EQ(test::writeTake(made, path), "");
  Result<TakeReader> take = TakeReader::open(path);
  std::filesystem::remove(path);
  return std::move(take).value();
}

TEST(Job, CamerasGoByNameAndNumber) {
  const TakeReader take = smallTake(true);
  EXPECT_EQ(chooseCamera(take, "")->name, "front");
  EXPECT_EQ(chooseCamera(take, "side")->name, "side");
  EXPECT_EQ(chooseCamera(take, "2")->name, "side");
  const Result<Camera> none = chooseCamera(take, "sied");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "--camera: found \"sied\", expected one of: front, side (did you mean \"side\"?)");
  EXPECT_FALSE(chooseCamera(take, "3"));
  const Result<Camera> made = chooseCamera(smallTake(false), "");
  ASSERT_TRUE(made);
  EXPECT_GT(length(made->position - made->target), 0.5);
}

TEST(Job, ACameraTurnsAboutItsTargetAndLooksAfterABody) {
  CameraMove move;
  move.camera.position = {0, 2, 5};
  move.camera.target = {0, 1, 1};
  move.orbitDegrees = 90;
  move.from = 1;
  move.to = 3;
  Instant instant{{Transform{{0, 1, 1}, {}}, Transform{{3, 0, 1}, {}}}, {true, true}};
  const auto expectAt = [&](double time, Vec3 position, Vec3 target) {
    const Camera camera = cameraAt(move, time, instant);
    EXPECT_LT(length(camera.position - position), 1e-12) << time;
    EXPECT_LT(length(camera.target - target), 1e-12) << time;
  };
  expectAt(0, {0, 2, 5}, {0, 1, 1});
  expectAt(3, {4, 2, 1}, {0, 1, 1});
  move.follow = 1;
  expectAt(1, {0, 2, 5}, {3, 0, 1});
  instant.there[1] = false;
  expectAt(1, {0, 2, 5}, {0, 1, 1});
  move.to = 1;  // one picture
  expectAt(1, {4, 2, 1}, {0, 1, 1});
  const TakeReader take = smallTake(true);
  const Result<std::uint32_t> last = chooseBody(take, take.bodies().back().name);
  ASSERT_TRUE(last);
  EXPECT_EQ(*last, take.bodies().size() - 1);
  EXPECT_NE(chooseBody(take, "bal").error().message.find("--follow: found \"bal\""), std::string::npos);
}

TEST(Job, MomentsFollowRateSpeedAndRange) {
  const TakeReader take = smallTake(true);  // 1 s
  RenderOptions options;
  EXPECT_EQ(momentsOf(take, options, OutputKind::film)->size(), 25u);
  options.speed = 0.5;
  EXPECT_EQ(momentsOf(take, options, OutputKind::film)->size(), 50u);
  options.from = 0.5;
  options.to = 0.6;
  const std::vector<double> moments = *momentsOf(take, options, OutputKind::film);
  ASSERT_EQ(moments.size(), 5u);
  EXPECT_EQ(moments[0], 0.5);
  EXPECT_NEAR(moments[4], 0.58, 1e-12);
  EXPECT_EQ(*momentsOf(take, options, OutputKind::still), std::vector<double>{0.5});
  options = {};
  options.frame = 30;
  EXPECT_NEAR(momentsOf(take, options, OutputKind::still)->at(0), 0.5, 1e-9);
  options.frame = 61;
  EXPECT_NE(momentsOf(take, options, OutputKind::still).error().message.find("--frame: found 61, expected 0 .. 60"),
            std::string::npos);
  options = {};
  options.from = 1.5;
  EXPECT_NE(momentsOf(take, options, OutputKind::film).error().message.find("--from: found 1.5"), std::string::npos);
}

TEST(Job, ATakeThatBeginsLateIsShownFromItsFirstFrame) {
  const TakeReader take = smallTake(true, 7);  // 7 .. 8 s
  RenderOptions options;
  const std::vector<double> whole = *momentsOf(take, options, OutputKind::film);
  ASSERT_EQ(whole.size(), 25u);
  EXPECT_NEAR(whole[0], 7, 1e-9);
  EXPECT_NEAR(momentsOf(take, options, OutputKind::still)->at(0), 7, 1e-9);
  options.from = 2;  // nothing was recorded there
  EXPECT_EQ(*momentsOf(take, options, OutputKind::film), whole);
  options.from = 7.8;
  EXPECT_EQ(momentsOf(take, options, OutputKind::film)->size(), 5u);
  options.from = {};
  options.to = 7.2;
  EXPECT_EQ(momentsOf(take, options, OutputKind::film)->size(), 5u);
  options.to = 3;
  EXPECT_EQ(momentsOf(take, options, OutputKind::film).error().message,
            "--to: found 3, expected more than 7 s, where the take begins");
}

TEST(Job, SunStandsOverTheLeftShoulderUnlessToldOtherwise) {
  Camera camera;
  camera.position = {0, 1, 5};
  camera.target = {0, 1, 0};
  const Sky sky = skyFor(camera, {});
  EXPECT_LT(sky.sun.x, -0.2f);
  EXPECT_GT(sky.sun.z, 0.2f);
  EXPECT_NEAR(skyFor(camera, Sun{90, 30}).sun.x, std::sqrt(0.75), 1e-6);
  // Of one that moves: where its path begins, whatever part of it is filmed.
  camera.path = {{1, {5, 1, 0}, {0, 1, 0}, 45}, {3, {0, 1, -5}, {0, 1, 0}, 45}};
  Camera start;
  start.position = {5, 1, 0};
  start.target = {0, 1, 0};
  EXPECT_EQ(skyFor(camera, {}).sun, skyFor(start, {}).sun);
}

// What the pictures are of: also the meshes of a scene, which lie in files of their own.
TEST(Source, FingerprintTellsWhatIsShown) {
  const std::string folder = testing::TempDir() + "brickfall_source_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  RenderOptions options;
  options.source = folder + "/scene.toml";
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder + name) << text; };
  const auto fingerprint = [&] {
    const SourceChoice choice = chooseSource(options);
    EXPECT_EQ(choice.exitCode, 0);
    return *fingerprintOf(choice.source, options);
  };
  write("/scene.toml", "[[body]]\ntype = \"fixed\"\nshape = \"mesh\"\nfile = \"hill.obj\"\n");
  write("/hill.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\nf 1 2 3\n");
  const std::uint64_t first = fingerprint();
  EXPECT_EQ(fingerprint(), first);
  write("/hill.obj", "v 0 0 0\nv 0 0 1\nv 2 0 0\nv 1 0 1\nf 1 2 3\n");
  const std::uint64_t moved = fingerprint();
  EXPECT_NE(moved, first) << "a corner elsewhere";
  write("/hill.obj", "v 0 0 0\nv 0 0 1\nv 2 0 0\nv 1 0 1\nf 1 2 3\nf 3 2 4\n");
  EXPECT_NE(fingerprint(), moved) << "one more triangle";
  const std::uint64_t last = fingerprint();
  options.seconds = 3;
  EXPECT_NE(fingerprint(), last);
  options = {};
  options.source = folder + "/none.take";
  const SourceChoice none = chooseSource(options);
  EXPECT_EQ(fingerprintOf(none.source, options).error().code, ErrorCode::inputOutput);
  std::filesystem::remove_all(folder);
}

TEST(FrameStore, GoesOnWithEqualSettingsOnly) {
  const std::string folder = testing::TempDir() + "brickfall_store_" + std::to_string(getpid());
  RenderOptions options;
  const std::string settings = settingsText(options, "wall", 7, 4), others = settingsText(options, "wall", 7, 8);
  options.threads = 9;  // changes no picture
  EXPECT_EQ(settingsText(options, "wall", 7, 4), settings);
  EXPECT_EQ(settingsDifference(settings, others), "found samples 4, expected samples 8");
  EXPECT_NE(settingsDifference(settings, settingsText(options, "wall", 8, 4)).find("source"), std::string::npos);
  {
    const Result<FrameStore> store = FrameStore::open(folder, settings);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_FALSE(store->has(0));
    EXPECT_FALSE(store->goesOn()) << "what of a take lies there is not of these settings";
    std::ofstream(store->frame(0)) << "x";
    EXPECT_TRUE(store->has(0));
  }
  ASSERT_TRUE(FrameStore::open(folder, settings));
  EXPECT_TRUE(FrameStore::open(folder, settings)->goesOn());
  const Result<FrameStore> refused = FrameStore::open(folder, others);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("samples 4, expected samples 8"), std::string::npos)
      << refused.error().message;
  FrameStore::open(folder, settings)->forgetSettings();
  EXPECT_FALSE(FrameStore::open(folder, settings)) << "pictures of nobody knows what";
  std::filesystem::rename(folder + "/frame_00000.png", folder + "/frame_00003.png");
  EXPECT_FALSE(FrameStore::open(folder, settings)) << "also if the first is not among them";
  std::filesystem::remove(folder + "/frame_00003.png");
  FrameStore::open(folder, settings)->remove(1);
  EXPECT_TRUE(std::filesystem::is_empty(folder)) << "a folder that was there before stays";
  std::filesystem::remove(FrameStore::open(folder + "2", settings)->frame(0));
  FrameStore::open(folder + "2", settings)->remove(1);
  EXPECT_FALSE(std::filesystem::exists(folder + "2"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace brickfall::render
