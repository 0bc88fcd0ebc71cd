// How far out of balance a body or a cluster is: the one measure for every caller. The residual is taken over a force,
// which is the weight or a share of the load. A torque counts as its force at an arm.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/take_larger.h"
#include "solver/island.h"

namespace brickfall {

//! - | too small: steps of rounding are taken for progress: cost | too large: slow ways to balance are given up
constexpr double kBetter = 0.8;  // of the least residual so far, or of its square: a step that leaves more is no better
//! - | too small: bodies whose points open and close are given up | too large: cost where floats round
constexpr int kStalledSteps = 4;  // so many steps in a row that are no better: rounding is all that is left. A body
                                  // takes so many exact steps in a row

// Counts the steps in a row that bettered nothing.
class Stall {
 public:
  int after(double residual) {
    steps_ = residual < kBetter * least_ ? 0 : steps_ + 1;
    least_ = std::min(least_, residual);
    return steps_;
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  int steps_ = 0;
};

struct Measure {
  double force = 0;  // N
  double arm = 0;    // m

  // The residual as a share of the measure's force; a residual that is not a number stays so.
  double of(const Wrench& residual) const {
    double out = 0;
    takeLarger(out, double(length(residual.force)) / force);
    takeLarger(out, double(length(residual.torque)) / (force * arm));
    return out;
  }
};

// `most` is in N.
inline bool isWithin(const Wrench& residual, float most, float arm) {
  const float turning = most * arm;
  return dot(residual.force, residual.force) <= most * most &&
         dot(residual.torque, residual.torque) <= turning * turning;
}
inline bool isWithin(const Wrench& residual, const Measure& measure, double share) {
  return isWithin(residual, float(share * measure.force), float(measure.arm));
}

// Residual of the cluster's bodies together, about the cluster's centre.
inline Wrench residualOf(const Island& island, const Level& level, const Cluster& cluster) {
  Wrench sum;
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    const Wrench& r = island.residual[body];
    sum.force += r.force;
    sum.torque += r.torque + cross(island.masses[body].position - cluster.centre, r.force);
  }
  return sum;
}

// Square of the radius of gyration, m2.
inline float gyrationSquared(const Cluster& c) { return (c.inertia[0] + c.inertia[2] + c.inertia[5]) / (3 * c.mass); }

// Measure of a body: the larger of so many of its weights and the given share of its load; arm: its inner radius.
inline Measure measureOf(const Island& island, const BodySet& bodies, std::size_t i, double ofLoad,
                         double weights = 1) {
  const BodyMass& m = bodies.mass[island.bodies[i]];
  return {std::max(weights * (m.mass * island.facts.scale.gravity), ofLoad * double(island.loads[i])), m.innerRadius};
}
// Measure of a cluster: its weight over the fourth root of its bodies, or the given share of their loads over the
// square root; arm: its radius of gyration. The residuals of a few heavily loaded bodies add up like chance.
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
