// Rows of a picture by several threads: each once, whatever goes wrong.
#include "render/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>

namespace brickfall::render {
namespace {

bool eachRowOnce(int threads) {
  std::vector<int> times(1000, 0);
  forRows(1000, threads, [&](int row) { times[std::size_t(row)]++; });
  return std::all_of(times.begin(), times.end(), [](int n) { return n == 1; });
}

TEST(Parallel, EachRowOnce) {
  for (int threads : {1, 2, 7}) EXPECT_TRUE(eachRowOnce(threads)) << threads;
}

TEST(Parallel, WhatARowThrowsComesOut) {
  for (int threads : {1, 3})
    EXPECT_THROW(forRows(100, threads,
                         [](int row) {
                           if (row == 40) throw std::runtime_error("row");
                         }),
                 std::runtime_error);
}

// Sanitizers need more address space than can be left here.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Parallel, GoesOnWithTheThreadsThereAre) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  ASSERT_GT(pages, 0u);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  const rlimit tight{pages * 4096 + (24u << 20), before.rlim_max};  // room for the stacks of two or three
  ASSERT_EQ(setrlimit(RLIMIT_AS, &tight), 0);
  bool refused = false;
  try {
    std::atomic<bool> end{false};
    std::vector<std::jthread> many;
    try {
      for (int i = 0; i < 64; i++) many.emplace_back([&] { end.wait(false); });
    } catch (const std::system_error&) {
      refused = true;
    }
    end = true;
    end.notify_all();
  } catch (...) {
  }
  const bool whole = eachRowOnce(64);
  setrlimit(RLIMIT_AS, &before);
  EXPECT_TRUE(refused) << "the limit does not reach what it should";
  EXPECT_TRUE(whole);
}
#endif

}  // namespace
}  // namespace brickfall::render
