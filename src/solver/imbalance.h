// How far out of balance a body or a cluster is: the one measure for whatever asks. Its residual over a force, which is its weight or
// a share of its load; a torque counts as the force that it is at an arm.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/take_larger.h"
#include "solver/rigid_cluster.h"

namespace brickfall {

struct Measure {
  double force = 0;  // N
  double arm = 0;    // m

  // As a share of it; what is not a number stays so.
  double of(const Wrench& residual) const {
    double out = 0;
    takeLarger(out, double(length(residual.force)) / force);
    takeLarger(out, double(length(residual.torque)) / (force * arm));
    return out;
  }
};

// `most`: N.
inline bool isWithin(const Wrench& residual, float most, float arm) {
  const float turning = most * arm;
  return dot(residual.force, residual.force) <= most * most &&
         dot(residual.torque, residual.torque) <= turning * turning;
}
inline bool isWithin(const Wrench& residual, const Measure& measure, double share) {
  return isWithin(residual, float(share * measure.force), float(measure.arm));
}

// Of a body: the largest of so many of its weights and such a share of its load; arm: its inner radius.
inline Measure measureOf(const Island& island, const BodySet& bodies, std::size_t i, double ofLoad,
                         double weights = 1) {
  const BodyMass& m = bodies.mass[island.bodies[i]];
  return {std::max(weights * (m.mass * island.facts.scale.gravity), ofLoad * double(island.loads[i])), m.innerRadius};
}
// Of a cluster: its weight over the fourth root of its bodies, or such a share of their loads over the square root; arm: its radius
// of gyration. What few bodies that carry much have left adds up like chance.
inline Measure measureOf(const Island& island, const Level& level, const Cluster& c, double ofLoad) {
  const double count = double(c.bodyEnd - c.bodyBegin);
  double load = 0;
  if (ofLoad > 0)
    for (std::uint32_t k = c.bodyBegin; k < c.bodyEnd; k++) load += double(island.loads[level.bodies[k]]);
  const double weight = double(c.mass) * island.dt * island.dt * island.facts.scale.gravity;
  return {std::max(weight / std::sqrt(std::sqrt(count)), ofLoad * load / std::sqrt(count)),
          std::sqrt(double(gyrationSquared(c)))};
}

}  // namespace brickfall
