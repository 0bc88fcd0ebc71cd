// One Newton step of a rigid cluster on the rows of its boundary.
//
//   residual  g = sum over its bodies (inertia and forces), about its centre
//   matrix    H = cluster mass and inertia / dt^2  +  sum over boundary rows of their stiffness, moved to the centre
//   step      x = H^-1 g, all bodies of the cluster move rigidly by t x
//
// The slope (residual . step) is positive while the step still lowers the energy. docs/step.md ("Cycles") says which
// points are in the matrix, how long its factor is kept, and when a step is searched for.
#include "solver/cluster_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/locks.h"
#include "solver/slope_search.h"

namespace brickfall {

namespace {

using wide::V;

// A step and how far along it the cluster is. The slope is the energy's slope downwards.
class Way {
 public:
  Way(RowForces& forces, const Level& level, const Cluster& cluster, Wrench step, const Wrench& residual, bool exact)
      : forces_(forces), level_(level), cluster_(cluster), step_(step), exact_(exact) {
    start_ = power(residual, step_);
    V turning = timesSymmetric(cluster.inertia, wide::load(&step_.torque.x));
    resist_ = power({step_.force * cluster.mass, wide::store3(turning)}, step_);
    if (!forces.island().plan.large) return;
    const Island& island = forces.island();
    float weight = cluster.mass * float(island.dt * island.dt * island.facts.scale.gravity);
    most_ = kNearMinimum * weight * (length(step_.force) + std::sqrt(gyrationSquared(cluster)) * length(step_.torque));
  }
  // Returns the slope there.
  float moveTo(float part) {
    Island& island = forces_.island();
    moveCluster(island, level_, cluster_, step_, part - at_, island.motion.data());
    at_ = part;
    return start_ + power(forces_.readBoundary(level_, cluster_, exact_, nullptr), step_) - part * resist_;
  }
  const Wrench& whole() const { return step_; }
  float at() const { return at_; }
  float start() const { return start_; }
  // Slopes between which a step ends near enough to its minimum.
  // Exact steps end nearer.
  float lowest() const { return lowest(exact_ ? 0.5f * kNearMinimum : kNearMinimum); }
  float lowest(float share) const { return -std::min(share * start_, most_); }
  float highest() const { return (exact_ ? kNearMinimum : kFarFromMinimum) * start_; }

 private:
  RowForces& forces_;
  const Level& level_;
  const Cluster& cluster_;
  Wrench step_;
  bool exact_;
  float start_, resist_, at_ = 0;
  // Slope that is too far beyond the minimum, by weight. Small islands are solved to the end.
  float most_ = std::numeric_limits<float>::infinity();
};

bool makeFactor(RowForces& forces, const Level& level, const Cluster& cluster, bool exact, ClusterFactor& factor) {
  factor.matrix = clusterMatrix(forces, level, cluster, exact);
  factor.kept = false;
  return factor.valid = factor.matrix.factor();
}

}  // namespace

void moveCluster(Island& island, const Level& level, const Cluster& cluster, const Wrench& step, float part,
                 const SolveMotion* from) {
  V way = wide::load(&step.force.x) * part, turn = wide::load(&step.torque.x) * part;
  V centre = wide::loadAnywhere(&cluster.centre.x);
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    SolveMotion& m = island.motion[body];
    V arm = wide::load(&island.masses[body].position.x) - centre;
    wide::store(wide::load(&from[body].d.x) + (way + wide::cross3(turn, arm)), &m.d.x);
    wide::store(wide::load(&from[body].th.x) + turn, &m.th.x);
  }
}

Symmetric6 clusterMatrix(RowForces& forces, const Level& level, const Cluster& cluster, bool exact) {
  MatrixSums sums;
  forces.readBoundary(level, cluster, exact, &sums);
  Symmetric6 matrix;
  sums.write(matrix);
  addInertia(matrix, cluster);
  if (const Island& island = forces.island(); anyLocks(island)) lockAxes(matrix, locksOf(island, level, cluster));
  return matrix;
}

ClusterStep tryStep(RowForces& forces, const Level& level, const Cluster& cluster, ClusterFactor& factor,
                    const Wrench& all, bool exact) {
  Wrench residual = all;
  if (const Island& island = forces.island(); anyLocks(island)) keepFree(residual, locksOf(island, level, cluster));
  for (;; factor.valid = false) {
    if (!factor.valid && !makeFactor(forces, level, cluster, exact, factor)) return {};
    const bool kept = std::exchange(factor.kept, true);
    Way way(forces, level, cluster, factor.matrix.solve(residual), residual, exact);
    if (!(way.start() > 0)) return {};
    float slope = way.moveTo(1);
    if (slope >= (kept ? way.lowest(kNearMinimum) : way.lowest())) {
      factor.valid = slope <= kNearMinimum * way.start();
      return {way.whole(), 1};
    }
    if (!kept) {
      searchAlong(way, slope);
      return {way.whole(), way.at()};
    }
    way.moveTo(0);
  }
}

void addInertiaOfStep(Island& island, const Level& level, const Cluster& cluster, const ClusterStep& step) {
  V way = wide::load(&step.whole.force.x) * step.part, turn = wide::load(&step.whole.torque.x) * step.part;
  V centre = wide::loadAnywhere(&cluster.centre.x);
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    const SolveMass& m = island.masses[body];
    Wrench& residual = island.residual[body];
    V moved = way + wide::cross3(turn, wide::load(&m.position.x) - centre);
    wide::store(wide::load(&residual.force.x) - moved * m.mass, &residual.force.x);
    wide::store(wide::load(&residual.torque.x) - timesSymmetric(m.inertia, turn), &residual.torque.x);
    if (anyLocks(island)) keepFree(residual, island.locks[body]);
  }
}

}  // namespace brickfall
