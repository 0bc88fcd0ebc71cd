// The pool against a plain record of what was given out: nothing overlaps, nothing is lost, and all of it comes back whole.
#include "base/pool.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace brickfall {
namespace {

// xorshift64
struct Numbers {
  std::uint64_t state = 88172645463325252ull;
  std::size_t below(std::size_t n) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return std::size_t(state % n);
  }
};

void expectSound(const Pool& pool) {
  std::vector<std::string> wrong = pool.validate();
  EXPECT_TRUE(wrong.empty()) << wrong.front();
}

TEST(Pool, WhatWasGivenBackServesAnySizeAgain) {
  Pool pool;
  pool.reserve(1 << 20);
  ASSERT_EQ(pool.capacity(), std::size_t(1) << 20);
  std::vector<void*> small;
  for (int i = 0; i < 1 << 14; i++) small.push_back(pool.allocate(64));
  EXPECT_EQ(pool.used(), pool.capacity());
  for (void* p : small) pool.deallocate(p, 64);
  EXPECT_EQ(pool.used(), 0u);
  void* all = pool.allocate(1 << 20);  // only if every half was joined again
  EXPECT_EQ(pool.capacity(), std::size_t(1) << 20) << "it took more from the system";
  pool.deallocate(all, 1 << 20);
  expectSound(pool);
}

TEST(Pool, RandomBlocksKeepTheirBytes) {
  Pool pool;
  Numbers random;
  struct Block {
    unsigned char* memory;
    std::size_t bytes;
    unsigned char mark;
  };
  std::vector<Block> held;
  int given = 0, taken = 0;
  for (int n = 0; n < 20000; n++) {
    if (held.empty() || random.below(100) < 52) {
      std::size_t bytes = 1 + random.below(std::size_t(1) << (1 + random.below(16)));
      Block b{static_cast<unsigned char*>(pool.allocate(bytes, 64)), bytes, static_cast<unsigned char>(n)};
      ASSERT_EQ(reinterpret_cast<std::uintptr_t>(b.memory) % 64, 0u);
      std::memset(b.memory, b.mark, bytes);
      held.push_back(b);
      given++;
    } else {
      std::size_t i = random.below(held.size());
      Block b = held[i];
      for (std::size_t k = 0; k < b.bytes; k++) ASSERT_EQ(b.memory[k], b.mark) << "block " << n << ", byte " << k;
      pool.deallocate(b.memory, b.bytes, 64);
      held[i] = held.back();
      held.pop_back();
      taken++;
    }
    if (n % 500 == 0) expectSound(pool);
  }
  EXPECT_GT(given, 5000);
  EXPECT_GT(taken, 5000);
  for (const Block& b : held) pool.deallocate(b.memory, b.bytes, 64);
  EXPECT_EQ(pool.used(), 0u);
  expectSound(pool);
}

TEST(Pool, NothingAndMuchAreServedToo) {
  Pool pool;
  void* none = pool.allocate(0);
  void* much = pool.allocate(3'000'000);
  ASSERT_NE(none, nullptr);
  ASSERT_NE(much, nullptr);
  EXPECT_NE(none, much);
  pool.deallocate(none, 0);
  pool.deallocate(much, 3'000'000);
  EXPECT_GE(pool.peak(), 3'000'000u);
  expectSound(pool);
}

}  // namespace
}  // namespace brickfall
