#include "solver/store.h"

namespace brickfall {

bool storeRows(Island& island, Ties& ties, StepContext& context) {
  bool changed = false;
  island.rows.eachKind([&](auto& kind) {
    changed = kind.store(island, ties, context) || changed;
    context.statistics.lightVisits += kind.kPoints * double(kind.size());
  });
  return changed;
}

void tellMean(const Island& island, Ties& ties, double step) {
  const float share = float(island.dt / step) - (island.part == IslandPart::last ? 1.0f : 0.0f);
  island.rows.eachKind([&](const auto& kind) { kind.tellShare(ties, share); });
}

void advanceRows(Island& island, Ties& ties, const StepContext& context) {
  if (island.resting()) return;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const SolvedMotion& s = context.solved[island.bodies[i]];
    island.motion[i].d = toFloat(s.d - island.rigid.of(context.bodies->motion[island.bodies[i]].position));
    island.motion[i].th = toFloat(s.th - island.rigid.turn);
  }
  island.rows.eachKind([&](const auto& kind) { kind.advance(island, ties, context); });
}

TieWork workOf(const Island& island, const StepContext& context) {
  TieWork sum;
  island.rows.eachKind([&](const auto& kind) { kind.addWork(island, context, sum); });
  return sum;
}

BalanceChange supportOf(const Island& island, const StepContext& context) {
  BalanceChange sum;
  island.rows.eachKind([&](const auto& kind) { kind.addSupport(island, context, sum); });
  return sum;
}

}  // namespace brickfall
