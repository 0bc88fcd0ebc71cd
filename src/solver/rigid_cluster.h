// A cluster as one rigid body: what it is out of balance by, and what that is judged by.
#pragma once
#include <cmath>

#include "solver/island.h"

namespace brickfall {

// Of its bodies together, about the cluster's centre.
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

// N: its weight over the fourth root of its bodies. `perDt2`: g dt^2, as the masses of clusters are per dt^2.
inline float clusterScale(const Cluster& c, float perDt2) {
  return c.mass * perDt2 / std::sqrt(std::sqrt(float(c.bodyEnd - c.bodyBegin)));
}
// m2
inline float gyrationSquared(const Cluster& c) { return (c.inertia[0] + c.inertia[2] + c.inertia[5]) / (3 * c.mass); }

}  // namespace brickfall
