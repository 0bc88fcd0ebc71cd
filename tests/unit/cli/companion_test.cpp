// Programs beside the command: which word starts which, with what, and what is said where one is missing.
#include "cli/companion.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "cli/commands.h"

namespace brickfall::cli {
namespace {

class CompanionStart : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = testing::TempDir() + "brickfall_companion_" + test + "_" + std::to_string(getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void program(const std::string& name, const std::string& script) const {
    std::ofstream(folder_ + "/" + name) << "#!/bin/sh\n" << script;
    ::chmod((folder_ + "/" + name).c_str(), 0755);
  }
  // The status that a process has that starts `word`; what it says is in said().
  int start(const char* word, const std::vector<std::string>& arguments) const {
    const pid_t child = ::fork();
    if (child == 0) {
      if (!std::freopen((folder_ + "/said").c_str(), "w", stdout) || ::dup2(1, 2) < 0) ::_exit(99);
      ::_exit(startCompanion(*findCompanion(word), folder_, arguments));
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return status;
  }
  std::string said() const {
    std::ifstream file(folder_ + "/said");
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string folder_;
};

TEST(Companions, AreKnownByTheirWords) {
  ASSERT_NE(findCompanion("view"), nullptr);
  EXPECT_STREQ(findCompanion("view")->program, "brickfall-view");
  ASSERT_NE(findCompanion("render"), nullptr);
  EXPECT_STREQ(findCompanion("render")->program, "brickfall-render");
  EXPECT_EQ(findCompanion("run"), nullptr);
  EXPECT_EQ(findCompanion(""), nullptr);
  EXPECT_TRUE(std::filesystem::is_directory(programFolder()));
}

TEST_F(CompanionStart, ArgumentsAndExitCodePassThrough) {
  program("brickfall-render", "for a in \"$@\"; do echo \"<$a>\"; done\nexit 42\n");
  const int status = start("render", {"a take", "--help", ""});
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(said(), "<a take>\n<--help>\n<>\n");
}

TEST_F(CompanionStart, SignalsPassThrough) {
  program("brickfall-view", "kill -TERM $$\n");
  const int status = start("view", {});
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST_F(CompanionStart, OneThatIsMissingOrBrokenIsOneLine) {
  const int missing = start("render", {"wall.take"});
  EXPECT_EQ(WEXITSTATUS(missing), kFileError);
  EXPECT_NE(said().find("brickfall-render' was not built; install the Debian packages libembree-dev libpng-dev"),
            std::string::npos)
      << said();
  std::ofstream(folder_ + "/brickfall-view") << "no program";
  const int broken = start("view", {});
  EXPECT_EQ(WEXITSTATUS(broken), kFileError);
  EXPECT_NE(said().find("view: cannot start '"), std::string::npos) << said();
}

}  // namespace
}  // namespace brickfall::cli
