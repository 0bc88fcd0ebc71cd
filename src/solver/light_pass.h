// The residuals of an island at the present motion.
#pragma once
#include "solver/locks.h"

namespace brickfall {

// Adds a row's force and torque on B, about its centre, to the residuals of those of its ends that are the island's
// own.
BRICKFALL_LANES void addTo(Wrench* residual, std::uint32_t bodies, RowEnds ends, Arms arms, wide::V force,
                           wide::V torque) {
  if (ends.a < bodies) {
    Wrench& r = residual[ends.a];
    wide::store(wide::load(&r.force.x) - force, &r.force.x);
    wide::store(wide::load(&r.torque.x) - (wide::cross3(arms.a, force) + torque), &r.torque.x);
  }
  if (ends.b < bodies) {
    Wrench& r = residual[ends.b];
    wide::store(wide::load(&r.force.x) + force, &r.force.x);
    wide::store(wide::load(&r.torque.x) + (wide::cross3(arms.b, force) + torque), &r.torque.x);
  }
}

//! not of the method: rows that lie in the nearest cache
inline constexpr std::size_t kRowsAtATime = 32;

// Reads all rows at the present motion, sums them into each body's residual, and tells of each: told(ends, reading), in
// the order of rows. `keep`: where the readings go, by row; may be null.
template <class Told> void readResiduals(Island& island, double& visits, Reading* keep, Told told) {
  const std::uint32_t bodies = std::uint32_t(island.bodies.size());
  island.residual.resize(bodies);
  for (std::size_t i = 0; i < bodies; i++) island.residual[i] = inertiaResidual(island.masses[i], island.motion[i]);
  Reading scratch[kRowsAtATime];
  std::as_const(island.rows).eachKind([&](const auto& kind) {
    for (std::size_t begin = 0; begin < kind.size(); begin += kRowsAtATime) {
      const std::size_t count = std::min(kRowsAtATime, kind.size() - begin);
      Reading* readings = keep ? keep : scratch;
      kind.read(begin, count, island.motion.data(), readings);
      for (std::size_t k = 0; k < count; k++) {
        const RowEnds ends = kind.ends(begin + k);
        addTo(island.residual.data(), bodies, ends, kind.arms(begin + k), readings[k].force, readings[k].torque);
        told(ends, readings[k]);
      }
      if (keep) keep += count;
    }
    visits += kind.kPoints * double(kind.size());
  });
  keepFree(island);
}

// Reads the forces at the present motion into Island::residual. With `renewBounds`, friction limits that follow the
// solve are renewed first: the residual that is judged is that of the valid friction limits.
void lightPass(Island& island, bool renewBounds, double& visits);
// N: half of a row's force, its share of the load of each of its bodies.
inline float halfOf(const Reading& x) { return 0.5f * length(wide::store3(x.force)); }
// Adds it to the loads of its bodies: Island::loads.
inline void addLoad(Island& island, RowEnds ends, const Reading& x) {
  const float half = halfOf(x);
  if (ends.a < island.loads.size()) island.loads[ends.a] += half;
  if (ends.b < island.loads.size()) island.loads[ends.b] += half;
}
// Largest residual of a body over its weight or, if that is more, over a fiftieth of its load. A torque counts as a
// force at the body's inner radius. In floats a body that carries thousands of weights cannot be balanced to a
// thousandth of its own.
double worstResidual(const Island& island, const BodySet& bodies);
// Residuals that a solve left, by each body's load: the largest one over max(weight, load) (torque as above), and
// how many bodies have more than 5 %.
struct LeftOver {
  double worst = 0;
  int bodies = 0;
};
LeftOver leftOver(const Island& island, const BodySet& bodies);
// Root of the mean square of |force residual| / weight.
double rmsResidual(const Island& island, const BodySet& bodies);

}  // namespace brickfall
