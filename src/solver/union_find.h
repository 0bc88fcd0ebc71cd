// Sets of numbers 0 .. count - 1 that are joined two by two.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace brickfall {

class UnionFind {
 public:
  UnionFind(std::size_t count, std::pmr::memory_resource* memory) : parent_(count, memory) {
    for (std::size_t i = 0; i < count; i++) parent_[i] = std::uint32_t(i);
  }
  // The lowest number of the set that i is in.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::pmr::vector<std::uint32_t> parent_;
};

}  // namespace brickfall
