// Every index once, whatever the number of threads and the size of the pieces. Run under -fsanitize=thread as well.
#include "parallel/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace brickfall {
namespace {

class WorkerPoolThreads : public testing::TestWithParam<int> {};

TEST_P(WorkerPoolThreads, EachIndexOnce) {
  WorkerPool pool(GetParam());
  EXPECT_EQ(pool.threads(), GetParam());
  for (int count : {0, 1, 2, 7, 64, 1000})
    for (int grain : {1, 3, 64, 5000}) {
      std::vector<int> hits(size_t(count), 0);
      std::atomic<int> pieces{0};
      std::atomic<bool> tooLong{false};
      pool.forRange(count, grain, [&](int begin, int end) {
        pieces++;
        if (end - begin > grain || end <= begin) tooLong = true;
        for (int i = begin; i < end; i++) hits[size_t(i)]++;
      });
      EXPECT_EQ(hits, std::vector<int>(size_t(count), 1));
      EXPECT_EQ(pieces, (count + grain - 1) / grain);
      EXPECT_FALSE(tooLong);
    }
}

TEST_P(WorkerPoolThreads, ManyShortRoundsSeeEachOthersResults) {
  WorkerPool pool(GetParam());
  std::vector<long> a(97, 1), b(97, 0);
  for (int round = 0; round < 3000; round++) {
    // Each round reads what other threads wrote in the one before.
    pool.forRange(97, 5, [&](int begin, int end) {
      for (int i = begin; i < end; i++) b[size_t(i)] = a[size_t(96 - i)] + 1;
    });
    std::swap(a, b);
  }
  for (long value : a) EXPECT_EQ(value, 3001);
}

TEST_P(WorkerPoolThreads, LoopInsideAPieceRunsOnThatThread) {
  WorkerPool pool(GetParam());
  std::vector<int> hits(40 * 30, 0);
  std::atomic<int> strangers{0};
  pool.forRange(40, 1, [&](int outer, int) {
    std::thread::id self = std::this_thread::get_id();
    pool.forRange(30, 4, [&](int begin, int end) {
      if (std::this_thread::get_id() != self) strangers++;
      for (int i = begin; i < end; i++) hits[size_t(outer * 30 + i)]++;
    });
  });
  EXPECT_EQ(hits, std::vector<int>(40 * 30, 1));
  EXPECT_EQ(strangers, 0);
}

INSTANTIATE_TEST_SUITE_P(OneToEight, WorkerPoolThreads, testing::Range(1, 9));

TEST(WorkerPool, OtherThreadsTakePart) {
  WorkerPool pool(3);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  // A piece ends only when all three threads hold one: it would hang if a worker slept on.
  std::atomic<int> arrived{0};
  pool.forRange(3, 1, [&](int, int) {
    {
      std::lock_guard<std::mutex> lock(mutex);
      seen.insert(std::this_thread::get_id());
    }
    arrived++;
    while (arrived < 3) std::this_thread::yield();
  });
  EXPECT_EQ(seen.size(), 3u);
}

TEST(WorkerPool, StartsAndStopsWithoutWork) {
  for (int i = 0; i < 50; i++) {
    WorkerPool pool(4);
    EXPECT_EQ(pool.threads(), 4);
  }
}

}  // namespace
}  // namespace brickfall
