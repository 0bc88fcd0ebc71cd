// A disk that fills up: a small tmpfs, in a name space of the test's own, so that nothing of it stays on the machine.
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>

#include "bad_input/cli/command_fixture.h"
#include "bad_input/cli/left_files.h"

namespace brickfall::test {
namespace {

class FullDisk : public Command {
 protected:
  // Empty, or what the system refused.
  std::string mountDisk(int kilobytes) {
    std::filesystem::create_directories(folder_ / "disk");
    const std::string size = "size=" + std::to_string(kilobytes) + "k";
    if (mount("none", (folder_ / "disk").c_str(), "tmpfs", 0, size.c_str()) == 0) return "";
    return std::string("mount: ") + std::strerror(errno);
  }
  std::string enterOwnMounts() {
    if (unshare(CLONE_NEWNS) != 0) return std::string("unshare: ") + std::strerror(errno);
    if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
      return std::string("mount --make-rprivate /: ") + std::strerror(errno);
    return mountDisk(64);
  }
  void unmountDisk() { umount2((folder_ / "disk").c_str(), MNT_DETACH); }
};

TEST_F(FullDisk, atAnyFillLeavesWholeFilesOnly) {
  if (const std::string problem = enterOwnMounts(); !problem.empty())
    GTEST_SKIP() << "missing: the right to mount a tmpfs (" << problem
                 << "; root has it). injected_fault_test.cpp makes every "
                 << "write fail without";
  unmountDisk();
  std::set<std::string> refused;
  int fine = 0;
  for (int kilobytes :
       {4, 8, 12, 16, 20, 24, 28, 32, 64, 128, 256, 512, 640, 660, 664, 668, 672, 676, 680, 720, 1024}) {
    ASSERT_EQ(mountDisk(kilobytes), "");
    const Finished end = run({"run", "wall", "--seconds", "1", "-o", "disk/out", "--quiet"});
    EXPECT_EQ(problemOfFiles(folder_ / "disk/out", false), "") << kilobytes;
    for (const char* name : {"wall.take", "replay.html", "wall.glb", "summary.json"}) {
      if (end.errors.find(std::string(name)) == std::string::npos) continue;
      refused.insert(name);
      EXPECT_NE(end.errors.find("No space left on device"), std::string::npos) << end.errors;
      EXPECT_FALSE(exists(std::string("disk/out/") + name)) << kilobytes;
    }
    EXPECT_EQ(end.exitCode, end.errors.empty() ? 0 : 3) << kilobytes << end.errors;
    fine += end.exitCode == 0;
    if (exists("disk/out/wall.take.part")) {
      EXPECT_EQ(run({"replay", "disk/out/wall.take.part", "-o", "again", "--quiet"}).exitCode, 0) << kilobytes;
      EXPECT_EQ(problemOfFiles(folder_ / "again", false), "");
    }
    unmountDisk();
  }
  EXPECT_GE(fine, 1);
  for (const char* name : {"wall.take", "replay.html", "wall.glb"}) EXPECT_TRUE(refused.count(name)) << name;
}

}  // namespace
}  // namespace brickfall::test
