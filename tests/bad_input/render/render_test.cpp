// brickfall-render as a process: bad arguments, no ffmpeg, breaks and going on.
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "bad_input/cli/command_fixture.h"

namespace brickfall::test {
namespace {

class Render : public Command {
 protected:
  // A small scene in the fixture's folder: a brick falls for a moment, fifteen pictures.
  std::vector<std::string> small(std::vector<std::string> more) const {
    write("drop.toml",
          "[world]\nseconds = 0.6\n[[body]]\nname = \"brick\"\nsize = [0.215, 0.065, 0.1025]\n"
          "position = [0, 0.5, 0]\n[[camera]]\nposition = [0.5, 0.5, 1]\ntarget = [0, 0.2, 0]\n");
    more.insert(more.begin(), "drop.toml");
    if (std::find(more.begin(), more.end(), "--size") == more.end()) more.insert(more.end(), {"--size", "64x36"});
    return more;
  }
  std::string frames(const std::string& folder) const {
    std::string all;
    for (int k = 0; k < 15; k++)
      all += read(folder + (k < 10 ? "/frame_0000" : "/frame_000") + std::to_string(k) + ".png");
    return all;
  }
};

TEST_F(Render, helpAndVersionAreNoErrors) {
  const Finished help = run({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.output.find("Exit codes:"), std::string::npos);
  EXPECT_EQ(run({"--version"}).output.rfind("brickfall ", 0), 0u);
}

TEST_F(Render, badArgumentsAreOneLineAndLeaveNothing) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "source is required"},
      {{"--frobnicate"}, "--frobnicate"},
      {{"--size", "960"}, "--size: found \"960\", expected WIDTHxHEIGHT"},
      {{"--samples", "0"}, "--samples: found \"0\", expected a whole number"},
      {{"--from", "soon"}, "--from: found \"soon\""},
      {{"--threads", "0"}, "--threads: found \"0\", expected a whole number from 1 to 64"},
      {{"--camera", "nobody", "-o", "x.png"}, "--camera: found \"nobody\", expected one of: main"},
      {{"--camera", "nobody", "-o", "pictures/"}, "--camera: found \"nobody\""},
      {{"--frame", "999", "-o", "x.png"}, "--frame: found 999, expected 0 .. 36"},
      {{"--from", "9", "-o", "x.png"}, "--from: found 9, expected at most 0.6 s"},
      {{"-o", "film.avi"}, "--output: found \"film.avi\""},
      {{"--frame", "3", "-o", "film.mp4"}, "--output: found \"film.mp4\", expected a .png file"},
      {{"--size", "65x36", "-o", "film.mp4"}, "--size: found \"65x36\", expected even numbers"},
      {{"--set", "=3"}, "--set: found \"=3\""},
      {{"--set", "world.secnds=3", "-o", "x.png"}, "secnds"},
  };
  for (const auto& [arguments, expected] : cases) {
    const Finished refused = arguments.empty() ? run({}) : run(small(arguments));
    EXPECT_EQ(refused.exitCode, 2) << expected << refused.errors;
    EXPECT_TRUE(isOneComplaint(refused.errors, {expected}));
    for (const char* left : {"x.png", "x.png.take", "film.mp4", "film.mp4.frames", "pictures", "out"})
      EXPECT_FALSE(exists(left)) << left << " after " << expected;
  }
}

TEST_F(Render, filesThatAreNoTakeOrScene) {
  write("bad.take", "no take");
  const Finished broken = run({"bad.take", "-o", "x.png"});
  EXPECT_EQ(broken.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(broken.errors, {"bad.take: not a Brickfall take"}));
  const Finished missing = run({"none.take", "-o", "x.png"});
  EXPECT_EQ(missing.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(missing.errors, {"none.take", "No such file"}));
  const Finished unknown = run({"cubee", "-o", "x.png"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_TRUE(isOneComplaint(unknown.errors, {"scene: found \"cubee\"", "did you mean \"cube\"?"}));
  const Finished nowhere = run(small({"-o", "/proc/none/x.png"}));
  EXPECT_EQ(nowhere.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(nowhere.errors, {"/proc/none"}));
}

TEST_F(Render, oneStill) {
  const Finished done = run(small({"--frame", "20", "--samples", "4", "-o", "still.png"}));
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  EXPECT_EQ(read("still.png").substr(1, 3), "PNG");
  EXPECT_FALSE(exists("still.png.take"));
  EXPECT_FALSE(exists("still.png.frames"));
}

TEST_F(Render, withoutFfmpegNothingIsSimulatedOrDrawn) {
  const Finished refused = run(small({"-o", "film.mp4"}), {.environment = {"PATH=/nowhere"}});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(refused.errors, {"ffmpeg: not found in PATH", "install the Debian package ffmpeg"}));
  EXPECT_FALSE(exists("film.mp4.frames"));
  EXPECT_EQ(run(small({"-o", "pictures/"}), {.environment = {"PATH=/nowhere"}}).exitCode, 0) << "a folder needs none";
}

TEST_F(Render, picturesOutliveAnFfmpegThatFails) {
  std::filesystem::create_directory(folder_ / "bin");
  write("bin/ffmpeg", "#!/bin/sh\n/bin/echo 'no such encoder' >&2\nexit 1\n");
  ::chmod((folder_ / "bin/ffmpeg").c_str(), 0755);
  const Finished failed = run(small({"-o", "film.mp4"}), {.environment = {"PATH=bin"}});
  EXPECT_EQ(failed.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(failed.errors, {"could not make the film: no such encoder", "kept in 'film.mp4.frames'"}));
  EXPECT_TRUE(exists("film.mp4.frames/frame_00014.png"));
  EXPECT_FALSE(exists("film.mp4"));
  EXPECT_FALSE(exists("film.mp4.part"));
  // With one that works only the film is still to be made.
  write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\n/bin/cat > \"$last\"\n");
  const Finished again = run(small({"-o", "film.mp4"}), {.environment = {"PATH=bin"}});
  EXPECT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_NE(again.output.find("15 of 15 pictures are there already"), std::string::npos) << again.output;
  EXPECT_EQ(read("film.mp4").size(), 15u * 64 * 36 * 3) << "every picture went through the pipe";
  EXPECT_FALSE(exists("film.mp4.frames"));
}

TEST_F(Render, aFilmIsMade) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "missing: the program ffmpeg";
  const Finished done = run(small({"-o", "film.mp4"}));
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  EXPECT_EQ(read("film.mp4").substr(4, 4), "ftyp");
  EXPECT_FALSE(exists("film.mp4.frames"));
}

// Broken off and gone on with, by other numbers of threads: the same pictures as in one go.
TEST_F(Render, goesOnAfterABreak) {
  ASSERT_EQ(run(small({"-o", "whole/", "--threads", "1", "--samples", "64"})).exitCode, 0);
  Process process(folder_, small({"-o", "broken/", "--threads", "2", "--samples", "64"}));
  while (process.running() && !exists("broken/frame_00003.png")) usleep(1000);
  process.send(SIGINT);
  const Finished broken = process.finish();
  EXPECT_EQ(broken.exitCode, 130) << broken.errors;
  EXPECT_TRUE(isOneComplaint(broken.errors, {"interrupted", "pictures are kept in 'broken/'"}));
  EXPECT_FALSE(exists("broken/frame_00014.png"));
  const auto kept = std::filesystem::last_write_time(folder_ / "broken/frame_00002.png");
  const Finished others = run(small({"-o", "broken/", "--samples", "32"}));
  EXPECT_EQ(others.exitCode, 2);
  EXPECT_TRUE(isOneComplaint(others.errors,
                             {"'broken/': pictures of other settings", "found samples 64, expected samples 32"}));
  const Finished rest = run(small({"-o", "broken/", "--threads", "1", "--samples", "64"}));
  EXPECT_EQ(rest.exitCode, 0) << rest.errors;
  EXPECT_NE(rest.output.find("of 15 pictures are there already"), std::string::npos) << rest.output;
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "broken/frame_00002.png"), kept) << "not made again";
  EXPECT_EQ(frames("broken"), frames("whole"));
  EXPECT_FALSE(exists("broken/scene.take"));
}

}  // namespace
}  // namespace brickfall::test
