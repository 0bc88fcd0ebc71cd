// Reads all forces at the present motion and sums them into each body's residual. Solves nothing.
#include "solver/light_pass.h"

#include <algorithm>
#include <cmath>

#include "base/take_larger.h"

namespace brickfall {

void lightPass(Island& island, bool renewBounds, double& visits) {
  std::size_t bodies = island.bodies.size();
  island.residual.resize(bodies);
  island.loads.assign(bodies, 0);
  for (std::size_t i = 0; i < bodies; i++) island.residual[i] = inertiaResidual(island.masses[i], island.motion[i]);
  const SolveMotion* motion = island.motion.data();
  island.rows.each([&](auto& kind, std::size_t k) {
    if (renewBounds) kind.renewBounds(k, motion);
    Reaction x = kind.react(k, motion);
    RowEnds ends = kind.ends(k);
    Vec3f force = wide::store3(x.force);
    float half = 0.5f * length(force);
    if (ends.a < bodies) {
      island.loads[ends.a] += half;
      island.residual[ends.a].force -= force;
      island.residual[ends.a].torque -= wide::store3(wide::cross3(x.armA, x.force) + x.torque);
    }
    if (ends.b < bodies) {
      island.loads[ends.b] += half;
      island.residual[ends.b].force += force;
      island.residual[ends.b].torque += wide::store3(wide::cross3(x.armB, x.force) + x.torque);
    }
  });
  island.rows.eachKind([&](const auto& kind) { visits += kind.kPoints * double(kind.size()); });
}

double worstResidual(const Island& island, const BodySet& bodies) {
  double worst = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyMass& m = bodies.mass[island.bodies[i]];
    double weight = std::max(m.mass * kReferenceGravity, kHeavyLoad * double(island.loads[i]));
    takeLarger(worst, double(length(island.residual[i].force)) / weight);
    takeLarger(worst, double(length(island.residual[i].torque)) / (weight * m.innerRadius));
  }
  return worst;
}

LeftOver leftOver(const Island& island, const BodySet& bodies) {
  LeftOver out;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyMass& m = bodies.mass[island.bodies[i]];
    double scale = std::max(m.mass * kReferenceGravity, double(island.loads[i]));
    double error = 0;
    takeLarger(error, double(length(island.residual[i].force)) / scale);
    takeLarger(error, double(length(island.residual[i].torque)) / (scale * m.innerRadius));
    takeLarger(out.worst, error);
    out.bodies += !(error <= kLeftOver);
  }
  return out;
}

double rmsResidual(const Island& island, const BodySet& bodies) {
  double sum = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    double error = double(length(island.residual[i].force)) / (bodies.mass[island.bodies[i]].mass * kReferenceGravity);
    sum += error * error;
  }
  return std::sqrt(sum / double(island.bodies.size()));
}

}  // namespace brickfall
