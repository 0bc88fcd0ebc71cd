// One Newton step of a rigid cluster on the rows of its boundary.
//
//   residual  g = sum over its bodies (inertia and forces), about its centre
//   matrix    H = cluster mass and inertia / dt^2  +  sum over boundary rows of their stiffness, moved to the centre
//   step      x = H^-1 g, all bodies of the cluster move rigidly by t x
//
// The slope (residual . step) is positive while the step still lowers the energy. Where the forces have kinks the full step may
// be too long: bracketed secant search (Illinois rule, every third time halving) for the zero of the slope.
//
// Open points nearer than kNearContact are in the matrix, so that no step runs through them; but what turns away from them, or
// towards one that is still far, then gets a step that can be a hundred times too short and seems to hang in the air. Exact
// steps leave them out and search instead.
#include "solver/cluster_step.h"

#include <algorithm>

namespace brickfall {

namespace {

//! - | too small: searches that change little | too large: steps end beyond their minimum
constexpr float kOvershoot = 0.3f, kOvershootExact = 0.15f;  // of the slope at the start: less is no reason to search
//! - | too small: searches that change little | too large: steps end short of their minimum
constexpr float kUndershoot = 0.5f, kUndershootExact = 0.3f;  // of the slope at the start: a search ends below it

float power(const Wrench& a, const Wrench& b) { return dot(a.force, b.force) + dot(a.torque, b.torque); }

Vec3f timesInertia(const float* i, Vec3f w) {
  return {i[0] * w.x + i[1] * w.y + i[3] * w.z, i[1] * w.x + i[2] * w.y + i[4] * w.z,
          i[3] * w.x + i[4] * w.y + i[5] * w.z};
}

void moveCluster(Island& island, const Level& level, const Cluster& cluster, const Wrench& step, float part) {
  Vec3f way = step.force * part, turn = step.torque * part;
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    SolveMotion& m = island.motion[body];
    m.d += way + cross(turn, island.masses[body].position - cluster.centre);
    m.th += turn;
  }
}

}  // namespace

Symmetric6 clusterMatrix(RowForces& forces, const Level& level, const Cluster& cluster, bool exact) {
  MatrixSums sums;
  forces.readBoundary(level, cluster, exact, &sums);
  Symmetric6 matrix;
  sums.write(matrix);
  addInertia(matrix, cluster);
  return matrix;
}

ClusterStep tryStep(RowForces& forces, const Level& level, const Cluster& cluster, ClusterFactor& factor,
                    const Wrench& residual, bool exact) {
  if (!factor.valid) {
    factor.matrix = clusterMatrix(forces, level, cluster, exact);
    if (!factor.matrix.factor()) return {};
    factor.valid = true;
  }
  Wrench x = factor.matrix.solve(residual);
  float turn = length(x.torque), most = float(kLargestTurn);
  if (turn > most) x = {x.force * (most / turn), x.torque * (most / turn)};
  float start = power(residual, x),
        resist = power({x.force * cluster.mass, timesInertia(cluster.inertia, x.torque)}, x);
  if (!(start > 0)) return {};
  float at = 0;
  auto slopeAt = [&](float t) {
    moveCluster(forces.island(), level, cluster, x, t - at);
    at = t;
    return start + power(forces.readBoundary(level, cluster, exact, nullptr), x) - t * resist;
  };
  float slope = slopeAt(1), lowest = -(exact ? kOvershootExact : kOvershoot) * start,
        highest = (exact ? kUndershootExact : kUndershoot) * start;
  if (slope >= lowest) return {x, at};
  float low = 0, slopeLow = start, high = 1, slopeHigh = slope;
  for (int k = 0; k < (exact ? kLineSearchStepsExact : kLineSearchSteps); k++) {
    float fall = slopeLow - slopeHigh, width = high - low;
    if (!(fall > 0)) break;  // both have underflowed: forces that a float hardly knows are balanced
    float next = k % 3 == 2 ? 0.5f * (low + high) : low + width * slopeLow / fall;
    if (k >= 1) next = std::min(std::max(next, low + 0.05f * width), high - 0.05f * width);
    slope = slopeAt(next);
    if (slope >= lowest && slope <= highest) break;
    // Otherwise one end of the bracket might never move.
    if (slope > 0) {
      low = next;
      slopeLow = slope;
      slopeHigh *= 0.5f;
    } else {
      high = next;
      slopeHigh = slope;
      slopeLow *= 0.5f;
    }
  }
  return {x, at};
}

void addInertiaOfStep(Island& island, const Level& level, const Cluster& cluster, const ClusterStep& step) {
  Vec3f way = step.whole.force * step.part, turn = step.whole.torque * step.part;
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    const SolveMass& m = island.masses[body];
    island.residual[body].force -= (way + cross(turn, m.position - cluster.centre)) * m.mass;
    island.residual[body].torque -= timesInertia(m.inertia, turn);
  }
}

}  // namespace brickfall
