// A fresh folder for each test, with a small scene in it.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "bad_input/cli/process.h"

namespace brickfall::test {

class Command : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("brickfall_") + info->test_suite_name() + "_" +
                                                           info->name() + "_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Finished run(const std::vector<std::string>& arguments, const ProcessOptions& options = {}) const {
    return runCommand(folder_, arguments, options);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  std::filesystem::path folder_;
};

// One line, that ours begins, and that holds each of the words.
inline testing::AssertionResult isOneComplaint(const std::string& errors, const std::vector<std::string>& words) {
  if (std::count(errors.begin(), errors.end(), '\n') != 1 || !errors.ends_with('\n'))
    return testing::AssertionFailure() << "not one line: " << errors;
  for (const std::string& word : words)
    if (errors.find(word) == std::string::npos)
      return testing::AssertionFailure() << "'" << word << "' is missing in: " << errors;
  return testing::AssertionSuccess();
}

}  // namespace brickfall::test
