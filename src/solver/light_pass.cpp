// Reads all forces at the present motion and sums them into each body's residual. Solves nothing.
#include "solver/light_pass.h"

#include <cmath>

#include "solver/imbalance.h"

namespace brickfall {

void lightPass(Island& island, bool renewBounds, double& visits) {
  if (renewBounds)
    island.rows.each([&](auto& kind, std::size_t k) { kind.renewBounds(k, island.motion.data(), 0, false); });
  island.loads.assign(island.bodies.size(), 0);
  readResiduals(island, visits, nullptr, [&](RowEnds ends, const Reading& x) { addLoad(island, ends, x); });
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
