#include "solver/numbering.h"

#include <algorithm>

namespace brickfall {

std::pmr::vector<std::uint32_t> nearPlaces(const Adjacency& adjacency) {
  std::pmr::memory_resource* memory = adjacency.list.get_allocator().resource();
  std::uint32_t n = adjacency.count();
  std::pmr::vector<char> seen(memory);
  std::pmr::vector<std::uint32_t> order(memory), places(n, 0, memory);
  order.reserve(n);
  auto visitFrom = [&](std::uint32_t first) {
    if (seen[first]) return;
    std::size_t i = order.size();
    seen[first] = 1;
    order.push_back(first);
    for (; i < order.size(); i++)
      for (std::uint32_t k = adjacency.begin[order[i]]; k < adjacency.begin[order[i] + 1]; k++)
        if (std::uint32_t next = adjacency.list[k]; !seen[next]) {
          seen[next] = 1;
          order.push_back(next);
        }
  };
  for (std::uint32_t sweep = 0, first = 0; sweep < 3; sweep++, first = order.back()) {
    seen.assign(n, 0);
    order.clear();
    visitFrom(first);
    for (std::uint32_t i = 0; i < n; i++) visitFrom(i);  // bodies that no tie joins to the first
  }
  for (std::uint32_t k = 0; k < order.size(); k++) places[order[k]] = n - 1 - k;
  return places;
}

std::pmr::vector<std::uint32_t> lowestPlaces(const Adjacency& adjacency,
                                             const std::pmr::vector<std::uint32_t>& places) {
  std::pmr::vector<std::uint32_t> lowest(places.size(), 0, adjacency.list.get_allocator());
  for (std::uint32_t i = 0; i < adjacency.count(); i++) {
    std::uint32_t& own = lowest[places[i]] = places[i];
    for (std::uint32_t k = adjacency.begin[i]; k < adjacency.begin[i + 1]; k++)
      own = std::min(own, places[adjacency.list[k]]);
  }
  return lowest;
}

}  // namespace brickfall
