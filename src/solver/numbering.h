// Which bodies are neighbours, and numbers by which neighbours are near each other.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace brickfall {

// Neighbours of each of some bodies or clusters, by number. Those of i stand in list[begin[i]] .. list[begin[i + 1] -
// 1], each once, in the order in which ties name them.
struct Adjacency {
  explicit Adjacency(std::pmr::memory_resource* memory) : begin(memory), list(memory) {}
  std::pmr::vector<std::uint32_t> begin, list;

  std::uint32_t count() const { return std::uint32_t(begin.size()) - 1; }
  // In `list`, of two that are neighbours.
  std::uint32_t find(std::uint32_t of, std::uint32_t neighbour) const {
    std::uint32_t k = begin[of];
    while (list[k] != neighbour) k++;
    return k;
  }
  // eachTie(visit) calls visit(a, b), a other than b, for each tie between two of `count`. A pair may be named many
  // times.
  template <class EachTie> void fill(std::uint32_t count, EachTie eachTie) {
    std::pmr::memory_resource* memory = list.get_allocator().resource();
    std::pmr::vector<std::uint32_t> room(count + 1, 0, memory), found(count, 0, memory);
    eachTie([&](std::uint32_t a, std::uint32_t b) {
      room[a + 1]++;
      room[b + 1]++;
    });
    for (std::uint32_t i = 0; i < count; i++) room[i + 1] += room[i];
    list.resize(room[count]);
    auto add = [&](std::uint32_t from, std::uint32_t to) {
      std::uint32_t* own = list.data() + room[from];
      for (std::uint32_t k = 0; k < found[from]; k++)
        if (own[k] == to) return;
      own[found[from]++] = to;
    };
    eachTie([&](std::uint32_t a, std::uint32_t b) {
      add(a, b);
      add(b, a);
    });
    begin.assign(1, 0);
    for (std::uint32_t i = 0; i < count; i++) {
      for (std::uint32_t k = 0; k < found[i]; k++) list[begin[i] + k] = list[room[i] + k];
      begin.push_back(begin[i] + found[i]);
    }
    list.resize(begin[count]);
  }
};

// Reverse Cuthill-McKee: outwards from a body that is far from the others (twice the last of a breadth-first sweep).
// The place of each number.
std::pmr::vector<std::uint32_t> nearPlaces(const Adjacency& adjacency);
// By place: the lowest place of a neighbour, or its own. Entries of a symmetric matrix left of that place are 0
// (block_envelope.h).
std::pmr::vector<std::uint32_t> lowestPlaces(const Adjacency& adjacency, const std::pmr::vector<std::uint32_t>& places);

}  // namespace brickfall
