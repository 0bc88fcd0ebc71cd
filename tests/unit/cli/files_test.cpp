#include "cli/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "brickfall/whole_file.h"

namespace brickfall::cli {
namespace {
namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) /
              (std::string("brickfall_files_") + info->name() + "_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  static std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path folder_;
};

TEST_F(Files, foldersAreMadeWithThoseAbove) {
  EXPECT_TRUE(makeFolder(in("a/b/c")));
  EXPECT_TRUE(fs::is_directory(in("a/b/c")));
  EXPECT_TRUE(makeFolder(in("a/b/c")));
}

TEST_F(Files, aFileInTheWayIsNamed) {
  ASSERT_TRUE(writeWhole(in("taken"), "text"));
  for (const std::string& folder : {in("taken"), in("taken/below/it")}) {
    const Status status = makeFolder(folder);
    ASSERT_FALSE(status) << folder;
    EXPECT_EQ(status.error().code, ErrorCode::inputOutput);
    EXPECT_NE(status.error().message.find("'" + in("taken") + "' is a file"), std::string::npos)
        << status.error().message;
  }
}

TEST_F(Files, writingReplacesAsAWhole) {
  ASSERT_TRUE(writeWhole(in("x"), "old and long"));
  ASSERT_TRUE(writeWhole(in("x"), "new"));
  EXPECT_EQ(content(in("x")), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "something was left aside";
}

TEST_F(Files, failedWritingLeavesNothing) {
  EXPECT_FALSE(writeWhole(in("missing/x"), "text"));
  fs::create_directories(in("folder/inside"));
  EXPECT_FALSE(writeWhole(in("folder"), "text"));
  EXPECT_FALSE(fs::exists(in("folder.part")));
}

TEST_F(Files, namesFromFilesStayInTheirFolder) {
  EXPECT_EQ(safeFileName("wall_hit-2.0"), "wall_hit-2.0");
  for (const char* bad : {"", ".", "..", "../x", "a/b", "/etc/x", ".hidden", "a b", "a\nb", "\xc3\xa4"})
    EXPECT_EQ(safeFileName(bad), "scene") << bad;
  EXPECT_EQ(safeFileName(std::string(101, 'a')), "scene");
}

TEST_F(Files, pathsAreJoined) {
  EXPECT_EQ(joinPath("", "x"), "x");
  EXPECT_EQ(joinPath("a", "x"), "a/x");
  EXPECT_EQ(joinPath("a/", "x"), "a/x");
}

}  // namespace
}  // namespace brickfall::cli
