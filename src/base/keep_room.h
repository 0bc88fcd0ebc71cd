// Room ahead of need, for lists that a step may lengthen. To be called between steps.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace brickfall {

// For a list that never holds more than `most` items.
template <class T> void keepRoomFor(std::vector<T>& list, std::size_t most) {
  if (list.capacity() < most) list.reserve(most + most / 2);
}

// For a list without a bound: room for `least` items, and for a fourth more than it holds (of very long lists for less:
// they change by a small share in a step).
template <class T> void keepRoom(std::vector<T>& list, std::size_t least) {
  constexpr std::size_t kMost = 100000;
  std::size_t spare = std::min(list.size() / 4, kMost);
  if (list.capacity() >= least && list.capacity() - list.size() >= spare) return;
  list.reserve(std::max(least, list.size() + list.size() / 2));
}

}  // namespace brickfall
