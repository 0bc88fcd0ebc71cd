// What a process may meet around it: streams that are closed, no terminal, no environment, odd names, files in use.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "bad_input/cli/command_fixture.h"
#include "bad_input/cli/left_files.h"

namespace brickfall::test {
namespace {

class Environment : public Command {
 protected:
  const std::vector<std::string> cube_ = {"run", "cube", "--seconds", "0.1", "-o", "out"};
  void expectAllFiles(const std::string& folder) const {
    EXPECT_EQ(problemOfFiles(folder_ / folder, false), "");
    for (const char* name : {"replay.html", "cube.glb", "summary.json", "cube.take"})
      EXPECT_TRUE(std::filesystem::exists(folder_ / folder / name)) << name;
  }
};

// The first file opened would get the number of the closed stream, and what is said would go into it.
TEST_F(Environment, closedStreams) {
  for (const std::vector<int>& closed : {std::vector<int>{0}, {1}, {2}, {0, 1}, {0, 1, 2}}) {
    std::filesystem::remove_all(folder_ / "out");
    ProcessOptions options;
    options.closed = closed;
    EXPECT_EQ(run(cube_, options).exitCode, 0);
    expectAllFiles("out");
  }
}

TEST_F(Environment, noTerminalNoVariablesNoReader) {
  ProcessOptions alone;
  alone.noTerminal = alone.emptyEnvironment = true;
  EXPECT_EQ(run(cube_, alone).exitCode, 0);
  expectAllFiles("out");
  ProcessOptions deaf;
  deaf.closedPipe = deaf.closedErrorPipe = true;
  EXPECT_EQ(run(cube_, deaf).exitCode, 0);
  EXPECT_EQ(run({"run", "no such scene"}, deaf).exitCode, 2);
  EXPECT_EQ(run({"run", "no/such/scene.toml"}, deaf).exitCode, 3);
}

TEST_F(Environment, oddNames) {
  for (const std::string name :
       {"two words", "line\nbreak", "M\xc3\xb6rtel \xe7\xa0\x96", "\xff\xfe", "-dash", "a'b\"c"}) {
    const Finished end = run({"run", "cube", "--seconds", "0.1", "-o", "./" + name});
    EXPECT_EQ(end.exitCode, 0) << end.errors;
    EXPECT_EQ(end.output.find("line\nbreak"), std::string::npos) << "control characters are not shown";
    expectAllFiles(name);
    EXPECT_EQ(run({"replay", "./" + name + "/cube.take", "-o", "./" + name + " again", "--quiet"}).exitCode, 0);
  }
  for (const std::string& name : {std::string(300, 'x'), std::string(5000, 'y')}) {
    const Finished end = run({"run", "cube", "-o", name});
    EXPECT_EQ(end.exitCode, 3);
    EXPECT_TRUE(isOneComplaint(end.errors, {name, "File name too long"}));
  }
}

TEST_F(Environment, aRecordingInUseIsNotMixed) {
  std::filesystem::create_directory(folder_ / "out");
  const int other = open((folder_ / "out/cube.take.part").c_str(), O_WRONLY | O_CREAT, 0644);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  ASSERT_EQ(::write(other, "theirs", 6), 6);
  const Finished refused = run(cube_);
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(refused.errors, {"out/cube.take.part", "being written by another process"}));
  EXPECT_EQ(read("out/cube.take.part"), "theirs");
  close(other);
  EXPECT_EQ(run(cube_).exitCode, 0) << "what a killed process left is used again";
  expectAllFiles("out");
}

TEST_F(Environment, aProtectedFileIsNotReplaced) {
  using std::filesystem::perms;
  std::filesystem::create_directory(folder_ / "out");
  std::filesystem::permissions(folder_ / "out", perms::all);
  write("out/cube.take", "kept");
  std::filesystem::permissions(folder_ / "out/cube.take", perms::owner_read | perms::others_read);
  ProcessOptions options;
  options.asNobody = true;
  const Finished refused = run(cube_, options);
  if (refused.exitCode == 126 || refused.exitCode == 127)
    GTEST_SKIP() << "missing: a build folder that others than root may enter";
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(refused.errors, {"out/cube.take", "Permission denied"}));
  EXPECT_EQ(read("out/cube.take"), "kept");
}

TEST_F(Environment, unreadableInputs) {
  const Finished memory = run({"run", "/proc/self/mem"});
  EXPECT_EQ(memory.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(memory.errors, {"/proc/self/mem", "Input/output error"}));
  const Finished endless = run({"check", "/dev/zero"});
  EXPECT_EQ(endless.exitCode, 2);
  EXPECT_NE(endless.errors.find("over 16 MiB"), std::string::npos) << endless.errors;
  for (const char* take : {"/proc/self/mem", "/dev/zero", "."}) {
    const Finished refused = run({"replay", take, "-o", "again"});
    EXPECT_EQ(refused.exitCode, 3) << take;
    EXPECT_TRUE(isOneComplaint(refused.errors, {take}));
    EXPECT_FALSE(exists("again"));
  }
}

// Renaming over it would put a file in its place.
TEST_F(Environment, aDeviceStaysADevice) {
  EXPECT_EQ(run({"trace", "cube", "--seconds", "0.1", "-o", "/dev/null", "--quiet"}).exitCode, 0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  const Finished full = run({"trace", "cube", "--seconds", "0.1", "-o", "/dev/full", "--quiet"});
  EXPECT_EQ(full.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(full.errors, {"/dev/full", "No space left on device"}));
}

}  // namespace
}  // namespace brickfall::test
