// A cluster as one rigid body: its residual and its radius of gyration.
#pragma once
#include <cmath>

#include "solver/island.h"

namespace brickfall {

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

}  // namespace brickfall
