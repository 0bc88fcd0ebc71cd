// Reads all forces at the present motion and sums them into each body's residual. Solves nothing.
#include "solver/light_pass.h"

#include <algorithm>
#include <cmath>

#include "solver/imbalance.h"
#include "solver/locks.h"
#include "solver/residual_sum.h"

namespace brickfall {

//! not of the method: rows that lie in the nearest cache
constexpr std::size_t kRowsAtATime = 32;

void lightPass(Island& island, bool renewBounds, double& visits) {
  const std::uint32_t bodies = std::uint32_t(island.bodies.size());
  island.residual.resize(bodies);
  island.loads.assign(bodies, 0);
  for (std::size_t i = 0; i < bodies; i++) island.residual[i] = inertiaResidual(island.masses[i], island.motion[i]);
  const SolveMotion* motion = island.motion.data();
  Reading readings[kRowsAtATime];
  island.rows.eachKind([&](auto& kind) {
    if (renewBounds)
      for (std::size_t k = 0; k < kind.size(); k++) kind.renewBounds(k, motion);
    for (std::size_t begin = 0; begin < kind.size(); begin += kRowsAtATime) {
      const std::size_t end = std::min(begin + kRowsAtATime, kind.size());
      kind.read(begin, end - begin, motion, readings);
      for (std::size_t k = begin; k < end; k++) {
        const Reading& x = readings[k - begin];
        RowEnds ends = kind.ends(k);
        addTo(island.residual.data(), bodies, ends, kind.arms(k), x.force, x.torque);
        float half = 0.5f * length(wide::store3(x.force));
        if (ends.a < bodies) island.loads[ends.a] += half;
        if (ends.b < bodies) island.loads[ends.b] += half;
      }
    }
    visits += kind.kPoints * double(kind.size());
  });
  keepFree(island);
}

double worstResidual(const Island& island, const BodySet& bodies) {
  double worst = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++)
    takeLarger(worst, measureOf(island, bodies, i, kHeavyLoad).of(island.residual[i]));
  return worst;
}

LeftOver leftOver(const Island& island, const BodySet& bodies) {
  LeftOver out;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const double error = measureOf(island, bodies, i, 1).of(island.residual[i]);
    takeLarger(out.worst, error);
    out.bodies += !(error <= kLeftOver);
  }
  return out;
}

double rmsResidual(const Island& island, const BodySet& bodies) {
  double sum = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const double error = measureOf(island, bodies, i, 0).of({island.residual[i].force, {}});
    sum += error * error;
  }
  return std::sqrt(sum / double(island.bodies.size()));
}

}  // namespace brickfall
