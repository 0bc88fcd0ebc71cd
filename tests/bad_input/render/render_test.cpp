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
  // A film with a program of this text in place of ffmpeg. `last`: the file that it is to write.
  Finished filmBy(const std::string& script, std::vector<std::string> more = {}) const {
    std::filesystem::create_directory(folder_ / "bin");
    write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\nlast=${last#file:}\n" + script);
    ::chmod((folder_ / "bin/ffmpeg").c_str(), 0755);
    more.insert(more.end(), {"-o", "film.mp4"});
    return run(small(more), {.environment = {"PATH=bin"}});
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
    for (const char* left : {"x.png", ".x.png.brickfall-render.take", "film.mp4", "film.mp4.frames", "pictures", "out"})
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
  EXPECT_FALSE(exists(".still.png.brickfall-render.take"));
  EXPECT_FALSE(exists("still.png.frames"));
}

// What a killed run left is of no use, and what looks like it is not ours to take or to delete.
TEST_F(Render, takesThatLieThereAreNotTakenForThatOfTheScene) {
  write(".still.png.brickfall-render.take", "of another run");
  const Finished still = run(small({"--samples", "4", "-o", "still.png"}));
  EXPECT_EQ(still.exitCode, 0) << still.errors;
  EXPECT_FALSE(exists(".still.png.brickfall-render.take"));
  std::filesystem::create_directory(folder_ / "pictures");
  write("pictures/scene.take", "the user's own");
  write("pictures/.brickfall-render.take", "of nobody knows which scene");
  const Finished pictures = run(small({"--samples", "2", "-o", "pictures/"}));
  EXPECT_EQ(pictures.exitCode, 0) << pictures.errors;
  EXPECT_EQ(read("pictures/scene.take"), "the user's own");
  EXPECT_FALSE(exists("pictures/.brickfall-render.take"));
}

TEST_F(Render, withoutFfmpegNothingIsSimulatedOrDrawn) {
  const Finished refused = run(small({"-o", "film.mp4"}), {.environment = {"PATH=/nowhere"}});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(refused.errors, {"ffmpeg: not found in PATH", "install the Debian package ffmpeg"}));
  EXPECT_FALSE(exists("film.mp4.frames"));
  EXPECT_EQ(run(small({"-o", "pictures/"}), {.environment = {"PATH=/nowhere"}}).exitCode, 0) << "a folder needs none";
}

TEST_F(Render, picturesOutliveAnFfmpegThatFails) {
  const Finished failed = filmBy("/bin/echo 'no such encoder' >&2\nexit 1\n");
  EXPECT_EQ(failed.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(failed.errors, {"could not make the film: no such encoder", "kept in 'film.mp4.frames'"}));
  EXPECT_TRUE(exists("film.mp4.frames/frame_00014.png"));
  EXPECT_FALSE(exists("film.mp4"));
  EXPECT_FALSE(exists("film.mp4.part"));
  // With one that works only the film is still to be made.
  const Finished again = filmBy("/bin/cat > \"$last\"\n");
  EXPECT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_NE(again.output.find("15 of 15 pictures are there already"), std::string::npos) << again.output;
  EXPECT_EQ(read("film.mp4").size(), 15u * 64 * 36 * 3) << "every picture went through the pipe";
  EXPECT_FALSE(exists("film.mp4.frames"));
}

// It may end well and the film be cut off all the same.
TEST_F(Render, anFfmpegThatSaysTooLittleIsNotBelieved) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"exit 0\n", "it ended before it had read all pictures"},
      {"echo half > \"$last\"\nexit 0\n", "it ended before it had read all pictures"},
      {"/bin/cat > \"$last\"\n/bin/echo 'Error writing trailer: No space left on device' >&2\nexit 0\n",
       "Error writing trailer: No space left"},
  };
  for (const auto& [script, said] : cases) {
    const Finished failed = filmBy(script);
    EXPECT_EQ(failed.exitCode, 3) << script;
    EXPECT_TRUE(isOneComplaint(failed.errors, {"could not make the film: " + said, "kept in 'film.mp4.frames'"}));
    EXPECT_TRUE(exists("film.mp4.frames/frame_00014.png")) << script;
    EXPECT_FALSE(exists("film.mp4") || exists("film.mp4.part")) << script;
  }
}

TEST_F(Render, picturesOfAFilmMayBeKept) {
  const Finished done = filmBy("/bin/cat > \"$last\"\n", {"--keep-frames"});
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  EXPECT_TRUE(exists("film.mp4"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "film.mp4.frames"), {}), 15)
      << "and nothing else";
  EXPECT_EQ(read("film.mp4.frames/frame_00014.png").substr(1, 3), "PNG");
}

TEST_F(Render, aFilmIsMade) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "missing: the program ffmpeg";
  const Finished done = run(small({"-o", "fi:lm.mp4"}));  // what stands before a colon is no protocol
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  EXPECT_EQ(read("fi:lm.mp4").substr(4, 4), "ftyp");
  EXPECT_FALSE(exists("fi:lm.mp4.frames"));
}

// The pictures are there, the film does not fit: it does not appear, and they stay.
TEST_F(Render, aDiskThatIsFullCostsNoPictures) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "missing: the program ffmpeg";
  ASSERT_EQ(filmBy("exit 1\n").exitCode, 3);
  const Finished full = run(small({"-o", "film.mp4"}), {.largestFile = 1500});
  EXPECT_EQ(full.exitCode, 3);
  EXPECT_NE(full.errors.find("could not make the film"), std::string::npos) << full.errors;
  EXPECT_FALSE(exists("film.mp4") || exists("film.mp4.part"));
  EXPECT_TRUE(exists("film.mp4.frames/frame_00014.png"));
  EXPECT_EQ(run(small({"-o", "film.mp4"})).exitCode, 0) << "with room";
  EXPECT_GT(read("film.mp4").size(), 1500u) << "or the disk was never full";
}

// Broken off and gone on with, by other numbers of threads: the same pictures as in one go. They are so large that the interrupt comes
// long before the last, however busy the machine is.
TEST_F(Render, goesOnAfterABreak) {
  const std::vector<std::string> large = {"--size", "160x90", "--samples", "64"};
  const auto job = [&](std::vector<std::string> more) {
    more.insert(more.end(), large.begin(), large.end());
    return small(more);
  };
  ASSERT_EQ(run(job({"-o", "whole/", "--threads", "1"})).exitCode, 0);
  Process process(folder_, job({"-o", "broken/", "--threads", "2"}));
  while (process.running() && !exists("broken/frame_00002.png")) usleep(1000);
  process.send(SIGINT);
  const Finished broken = process.finish();
  EXPECT_EQ(broken.exitCode, 130) << broken.errors;
  EXPECT_TRUE(isOneComplaint(broken.errors, {"interrupted", "pictures are kept in 'broken/'"}));
  EXPECT_FALSE(exists("broken/frame_00014.png"));
  const auto kept = std::filesystem::last_write_time(folder_ / "broken/frame_00002.png");
  const Finished others = run(small({"-o", "broken/", "--samples", "32", "--size", "160x90"}));
  EXPECT_EQ(others.exitCode, 2);
  EXPECT_TRUE(isOneComplaint(others.errors,
                             {"'broken/': pictures of other settings", "found samples 64, expected samples 32"}));
  const Finished rest = run(job({"-o", "broken/", "--threads", "1"}));
  EXPECT_EQ(rest.exitCode, 0) << rest.errors;
  EXPECT_NE(rest.output.find("of 15 pictures are there already"), std::string::npos) << rest.output;
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "broken/frame_00002.png"), kept) << "not made again";
  EXPECT_EQ(frames("broken"), frames("whole"));
  EXPECT_FALSE(exists("broken/.brickfall-render.take"));
}

}  // namespace
}  // namespace brickfall::test
