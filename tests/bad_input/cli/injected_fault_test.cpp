// Every call of the system that touches a file, one after the other: it fails, with a full disk or a read error, or the
// process dies in it. tests/bad_input/cli/fault_injector.cpp does that.
#include <cerrno>
#include <csignal>
#include <cstring>
#include <map>

#include "bad_input/cli/command_fixture.h"
#include "bad_input/cli/left_files.h"
#include "brickfall/take.h"

namespace brickfall::test {
namespace {

class InjectedFault : public Command {
 protected:
  // In a fresh folder. The call that was hit, empty once the command makes fewer calls than that.
  std::string runWithFault(const std::vector<std::string>& arguments, int call, const std::string& kind,
                           Finished& end) {
    std::filesystem::remove_all(folder_ / "out");
    std::filesystem::remove(folder_ / "fault.txt");
    ProcessOptions options;
    options.environment = {std::string("LD_PRELOAD=") + BRICKFALL_FAULTS, "ASAN_OPTIONS=verify_asan_link_order=0",
                           "BRICKFALL_FAULT=" + std::to_string(call) + " " + kind, "BRICKFALL_FAULT_LOG=fault.txt"};
    end = run(arguments, options);
    return read("fault.txt");
  }

  static constexpr int kMostCalls = 1000;
  const std::vector<std::string> cube_ = {"run", "cube", "--seconds", "0.1", "-o", "out", "--quiet"};
};

TEST_F(InjectedFault, everyRefusedCallIsSaidAndLeavesWholeFilesOnly) {
  std::map<std::string, int> hit;
  for (int call = 1; call < kMostCalls; call++) {
    for (const int reason : {ENOSPC, EIO}) {
      Finished end;
      const std::string name = runWithFault(cube_, call, std::to_string(reason), end);
      if (name.empty()) {
        call = kMostCalls;
        break;
      }
      hit[name]++;
      EXPECT_EQ(end.exitCode, 3) << name << " " << call << end.errors;
      EXPECT_TRUE(isOneComplaint(end.errors, {std::strerror(reason)})) << name << " " << call;
      EXPECT_TRUE(end.errors.find("out") != std::string::npos || end.errors.find("cube.toml") != std::string::npos)
          << "no file is named: " << end.errors;
      EXPECT_EQ(problemOfFiles(folder_ / "out", false), "") << name << " " << call;
    }
  }
  for (const char* call : {"open", "read", "fopen", "fread", "write", "fsync", "ftruncate", "rename", "mkdir"})
    EXPECT_GE(hit[call], 2) << call << " was never made to fail";
}

TEST_F(InjectedFault, dyingInAnyCallLeavesWholeFilesOnly) {
  std::map<std::string, int> hit;
  int cutOff = 0;
  for (int call = 1; call < kMostCalls; call++) {
    Finished end;
    const std::string name = runWithFault(cube_, call, "kill", end);
    if (name.empty()) break;
    hit[name]++;
    EXPECT_EQ(end.signal, SIGKILL) << name << " " << call;
    EXPECT_EQ(problemOfFiles(folder_ / "out", true), "") << name << " " << call;
    const Result<TakeReader> take = TakeReader::open((folder_ / "out/cube.take.part").string());
    if (!take || take->frameCount() == 0) continue;
    cutOff++;
    const Finished again = run({"replay", "out/cube.take.part", "-o", "again", "--quiet"});
    EXPECT_EQ(again.exitCode, 0) << name << " " << call;
    EXPECT_EQ(problemOfFiles(folder_ / "again", false), "");
  }
  for (const char* call : {"open", "read", "fopen", "fread", "write", "fsync", "ftruncate", "rename"})
    EXPECT_GE(hit[call], 1) << call;
  EXPECT_GE(cutOff, 5);
}

TEST_F(InjectedFault, aReplayThatCannotReadOrWrite) {
  ASSERT_EQ(run({"run", "cube", "--seconds", "0.1", "-o", "made", "--quiet"}).exitCode, 0);
  std::map<std::string, int> hit;
  for (int call = 1; call < kMostCalls; call++) {
    Finished end;
    const std::string name =
        runWithFault({"replay", "made/cube.take", "-o", "out", "--quiet"}, call, std::to_string(EIO), end);
    if (name.empty()) break;
    hit[name]++;
    EXPECT_EQ(end.exitCode, 3) << name << " " << call;
    EXPECT_TRUE(isOneComplaint(end.errors, {std::strerror(EIO)})) << name << " " << call;
    EXPECT_EQ(problemOfFiles(folder_ / "out", false), "") << name << " " << call;
  }
  for (const char* call : {"fopen", "fread", "write", "fsync", "rename"}) EXPECT_GE(hit[call], 1) << call;
}

}  // namespace
}  // namespace brickfall::test
