// A synthetic take opened for reading, in a folder of its own.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "brickfall/output.h"
#include "support/synthetic_take.h"

namespace brickfall::test {

struct OutputFolder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / ("output_" + std::to_string(::getpid()));
  OutputFolder() { std::filesystem::create_directory(path); }
  ~OutputFolder() { std::filesystem::remove_all(path); }
  std::string file(const char* name) const { return (path / name).string(); }
  std::size_t files() const {
    return std::size_t(std::distance(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator()));
  }
};

inline TakeReader opened(const SyntheticTake& take, const std::string& path) {
  EXPECT_EQ(writeTake(take, path), "");
  Result<TakeReader> reader = TakeReader::open(path);
  EXPECT_TRUE(reader);
  return std::move(reader).value();
}

inline std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Cancels after `calls` calls; checks on the way that the share rises.
struct Canceller {
  int calls = 0;
  double last = 0;
  bool operator()(double share) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1);
    last = share;
    return calls-- > 0;
  }
};

}  // namespace brickfall::test
