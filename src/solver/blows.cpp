#include "solver/blows.h"

#include <utility>

#include "solver/island.h"

namespace brickfall {

namespace {

// Marks bodies and partners that a row of a kind that yields holds. False if there is none.
bool findYielding(const Island& island, std::pmr::vector<char>& yielding) {
  if (!island.rows.anyYielding()) return false;
  yielding.assign(island.bodies.size() + island.partners.size(), 0);
  island.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if (!Kind::kYields) return;
    const RowEnds ends = kind.ends(k);
    yielding[ends.a] = yielding[ends.b] = 1;
  });
  return true;
}

}  // namespace

void giveBlows(Island& island, bool last, Ties& ties, BodySet& bodies, const StepContext& context) {
  island.blows.impacts.clear();
  island.blows.crushes.clear();
  island.blows.change = {};
  std::pmr::vector<char> yielding(island.memory);
  if (!findYielding(island, yielding)) return;
  auto holding = [&](std::uint32_t body, Vec3 along) {
    Holding sum;
    std::as_const(island.rows).each([&](const auto& kind, std::size_t k) {
      const RowEnds ends = kind.ends(k);
      if (ends.a == body || ends.b == body) kind.addHolding(k, along, ties, bodies, sum);
    });
    return sum;
  };
  const Held held{yielding, holding};
  island.rows.eachKind(
      [&](const auto& kind) { kind.giveBlows(held, last ? island.dt : 0, ties, bodies, context, island.blows); });
}

}  // namespace brickfall
