// What holds a body up: chains of rows to something fixed or kinematic.
#pragma once
#include <utility>

#include "solver/island.h"

namespace brickfall {

// Marks the bodies (and all partners) from which a chain of rows that `counts(kind, k)` leads to a partner.
template <class Counts> void findSupported(const Island& island, std::pmr::vector<char>& supported, Counts&& counts) {
  std::size_t bodies = island.bodies.size();
  supported.assign(bodies + island.partners.size(), 0);
  std::fill(supported.begin() + std::ptrdiff_t(bodies), supported.end(), 1);
  std::pmr::vector<std::pair<std::uint32_t, std::uint32_t>> links(island.memory);
  links.reserve(island.rows.size());
  island.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (counts(kind, k)) links.push_back({ends.a, ends.b});
  });
  for (bool grew = true, forwards = true; grew; forwards = !forwards) {
    grew = false;
    auto join = [&](std::pair<std::uint32_t, std::uint32_t> l) {
      if (supported[l.first] == supported[l.second]) return;
      supported[l.first] = supported[l.second] = 1;
      grew = true;
    };
    if (forwards)
      for (std::size_t i = 0; i < links.size(); i++) join(links[i]);
    else
      for (std::size_t i = links.size(); i-- > 0;) join(links[i]);
  }
}

}  // namespace brickfall
