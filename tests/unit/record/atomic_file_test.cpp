// A file appears whole or not at all.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "record/atomic_file.h"

namespace brickfall {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("atomic_" + std::to_string(::getpid()));
  Folder() { fs::create_directory(path); }
  ~Folder() { fs::remove_all(path); }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(path), {})); }
};

std::string contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(AtomicFile, ReplacesItsPlaceOnlyAtTheEnd) {
  Folder folder;
  std::string path = (folder.path / "a.txt").string();
  std::ofstream(path) << "old";
  AtomicFile file(path);
  ASSERT_TRUE(file.open());
  file.write(std::string_view("new text"));
  EXPECT_EQ(contentOf(path), "old");
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(contentOf(path), "new text");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  Folder folder;
  {
    AtomicFile file((folder.path / "a.txt").string());
    ASSERT_TRUE(file.open());
    file.write(std::string_view("half"));
    EXPECT_EQ(folder.files(), 1u);
  }
  EXPECT_EQ(folder.files(), 0u);
}

TEST(AtomicFile, SaysWhichFileCannotBeMade) {
  AtomicFile missing("/nowhere/at/all/a.txt");
  Status opened = missing.open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::inputOutput);
  EXPECT_NE(opened.error().message.find("/nowhere/at/all/a.txt"), std::string::npos);

  Folder folder;
  fs::create_directory(folder.path / "taken");
  AtomicFile onFolder((folder.path / "taken").string());
  ASSERT_TRUE(onFolder.open());
  Status committed = onFolder.commit();
  ASSERT_FALSE(committed);
  EXPECT_EQ(committed.error().code, ErrorCode::inputOutput);
  EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace brickfall
