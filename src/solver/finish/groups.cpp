#include "solver/finish/groups.h"

#include <algorithm>

#include "solver/island.h"
#include "solver/union_find.h"

namespace brickfall {

void Groups::find(const Island& island, const StepContext& context) {
  for (auto* list : {&of_, &pieceOf_, &bodies_, &begin_, &partner_}) list->clear();
  if (island.resting()) return;
  const std::size_t count = island.bodies.size();
  UnionFind sets(count, island.memory);
  std::pmr::vector<RowEnds> grounds(island.memory);  // a body, and a partner that it presses on
  island.rows.each([&](const auto& kind, std::size_t k) {
    if (!kind.ties(k, context)) return;
    const RowEnds ends = kind.ends(k);
    if (ends.a < count && ends.b < count) return sets.join(ends.a, ends.b);
    grounds.push_back({std::min(ends.a, ends.b), std::max(ends.a, ends.b)});
  });
  pieceOf_.resize(count);
  for (std::uint32_t i = 0; i < count; i++) pieceOf_[i] = sets.find(i);
  for (RowEnds ground : grounds) sets.join(grounds.front().a, ground.a);
  // Numbers groups in the order of their lowest bodies, which name the sets.
  of_.resize(count);
  std::pmr::vector<std::uint32_t> sizes(island.memory);
  for (std::uint32_t i = 0; i < count; i++) {
    const std::uint32_t lowest = sets.find(i);
    if (lowest == i) {
      of_[i] = std::uint32_t(sizes.size());
      sizes.push_back(0);
      partner_.push_back(!grounds.empty() && sets.find(grounds.front().a) == i ? grounds.front().b : kNoIndex);
    }
    of_[i] = of_[lowest];
    sizes[of_[i]]++;
  }
  begin_.push_back(0);
  for (std::uint32_t size : sizes) begin_.push_back(begin_.back() + size);
  bodies_.resize(count);
  std::pmr::vector<std::uint32_t> next(begin_.begin(), begin_.end(), island.memory);
  for (std::uint32_t i = 0; i < count; i++) bodies_[next[of_[i]]++] = i;
}

}  // namespace brickfall
