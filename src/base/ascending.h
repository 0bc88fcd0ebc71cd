// Lists in ascending order, each item once.
#pragma once
#include <algorithm>

namespace brickfall {

template <class List> bool isAscending(const List& list) {
  return std::adjacent_find(list.begin(), list.end(), [](const auto& a, const auto& b) { return !(a < b); }) ==
         list.end();
}
template <class List> void makeAscending(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}
// If it is not there yet.
template <class List, class Item> void insertAscending(List& list, const Item& item) {
  const auto place = std::lower_bound(list.begin(), list.end(), item);
  if (place == list.end() || *place != item) list.insert(place, item);
}

}  // namespace brickfall
