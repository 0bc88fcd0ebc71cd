// Clusters move rigidly, so cycles are slow where an island must bend or part in many places at once. An arch or a wall
// that begins to collapse seems to hang. With the friction limits frozen the step is the minimum of a strictly convex
// energy, and Newton with a search along each step converges from anywhere. Its matrix has 6 rows a body. Bodies are
// numbered so that neighbours are near (reverse Cuthill-McKee). So in an island of some dozens of bodies the envelope
// is narrow, and a factorisation costs about as much as a few cycles.
#include "solver/direct_solve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/block_envelope.h"
#include "solver/body_matrix.h"
#include "solver/imbalance.h"
#include "solver/joint/swings.h"
#include "solver/light_pass.h"
#include "solver/locks.h"
#include "solver/numbering.h"
#include "solver/renewals.h"
#include "solver/rounding.h"
#include "solver/row_forces.h"
#include "solver/slope_search.h"

namespace brickfall {

namespace {

// Half of all solves are done after 1 step, 99 % after 45, all after 51: scene `wall`, its rubble.
//! - | too small: rubble is left with many weights unbalanced | too large: cost of rubble
constexpr int kDirectSteps = 100;
//! - | too small: cost | too large: steps jump to and fro over edges that open and close: leaning bodies stay up
constexpr double kEnoughStalled = 0.1;  // the same after kStalledSteps

class Newton {
 public:
  Newton(Island& island, SolveStatistics& statistics)
      : island_(island),
        statistics_(statistics),
        place_(island.bodies.size(), 0, island.memory),
        step_(6 * island.bodies.size(), 0.0, island.memory),
        from_(island.memory),
        rounding_(island.memory),
        tight_(island.memory),
        matrix_(island.memory) {
    if (island.facts.firm) rounding_.resize(island.bodies.size());
    Adjacency neighbours(island.memory);
    neighbours.fill(std::uint32_t(place_.size()), [this](auto visit) { eachTie(visit); });
    place_ = nearPlaces(neighbours);
    matrix_.shape(lowestPlaces(neighbours, place_));
  }

  // One step to about the minimum of the energy along it. `tight`: ropes that are slack by less than their ends go in
  // this time step count as tight, for a row of them that snaps would close one by one. `again`: by the last matrix,
  // which is nearly that of now. False if the matrix is not positive definite.
  bool step(bool boundsFollow, double enough, bool tight, bool again) {
    if (!(again ? solve() : findStep(tight))) return false;
    if (!tight_.empty() && !(slope() > 0) && !findStep(false)) return false;
    from_.assign(island_.motion.begin(), island_.motion.begin() + std::ptrdiff_t(place_.size()));
    search(enough);
    if (boundsFollow && !island_.facts.jointsAlone()) readForces(true);
    return true;
  }
  // Of joints alone, what was frozen changes forces, and stiffness next to nothing: but which bounds are reached.
  bool stiffnessStays() const { return island_.facts.jointsAlone() && !hasBounds(island_); }

  // The largest residual over its body's measure, which counts what floats round.
  double worst(const BodySet& bodies) const {
    if (rounding_.empty()) return worstResidual(island_, bodies);
    const double share = island_.plan.tolerance;
    double worst = 0;
    for (std::size_t i = 0; i < place_.size(); i++)
      takeLarger(worst, over(island_.residual[i], measureOf(island_, bodies, i, kHeavyLoad), share, rounding_[i]));
    return share * worst;
  }

  // Sets the friction limits of new points by the forces that were found, and the multipliers of joints. True if any
  // changed.
  bool settleBounds() {
    bool any = false;
    island_.rows.each([&](auto& kind, std::size_t k) {
      any = (kind.boundsFollow(k) && kind.settleBounds(k, island_.motion.data(), float(kTrifle))) || any;
    });
    if (any) readForces(false);
    return any;
  }

 private:
  double& entry(std::size_t body, int k) { return step_[6 * place_[body] + std::size_t(k)]; }
  bool inside(RowEnds ends) const { return ends.a < place_.size() && ends.b < place_.size(); }
  // visit(a, b) for each row between two bodies of the island.
  template <class Visit> void eachTie(Visit visit) const {
    std::as_const(island_.rows).each([&](const auto& kind, std::size_t k) {
      if (RowEnds ends = kind.ends(k); inside(ends)) visit(ends.a, ends.b);
    });
  }
  void readForces(bool boundsFollow) { lightPass(island_, boundsFollow, statistics_.lightVisits); }

  bool findStep(bool tight) {
    assemble(tight);
    return matrix_.factor() && solve();
  }
  bool solve() {
    for (std::size_t i = 0; i < place_.size(); i++)
      for (int k = 0; k < 3; k++) {
        entry(i, k) = double(island_.residual[i].force[k]);
        entry(i, k + 3) = double(island_.residual[i].torque[k]);
      }
    for (const Tight& rope : tight_) {
      pull(rope.ends.a, rope.armA, -rope.force);
      pull(rope.ends.b, rope.armB, rope.force);
    }
    matrix_.solve(step_.data());
    if (anyLocks(island_)) leaveLocked();
    return true;
  }

  // A slack rope that counts as tight, with the force by which it would push.
  struct Tight {
    RowEnds ends;
    Vec3f armA, armB, force;  // m, N: on B
  };
  template <class Kind> void holdTight(const Kind&, std::size_t, StiffReaction&) {}
  void holdTight(const JointRows& joints, std::size_t k, StiffReaction& x) {
    const JointRecord& r = joints.records[k];
    if (joints.starts[k].across == 0 || r.way.most[0] != 0) return;
    const float push = joint::trialOf(r.way, joint::relativeMotion(r, island_.motion.data()).way)[0];
    float reach = 0;
    for (std::uint32_t body : {r.bodyA, r.bodyB})
      if (body < place_.size()) reach += length(island_.motion[body].d);
    if (!(push > 0 && push < r.way.k[0] * reach)) return;
    const wide::V axis = wide::load(&r.way.axes[0].unit.x);
    for (int i = 0; i < 3; i++) x.stiffness.A[i] += axis * (r.way.k[0] * axis[i]);
    tight_.push_back({joints.ends(k), wide::store3(x.armA), wide::store3(x.armB), r.way.axes[0].unit * push});
  }
  void pull(std::uint32_t body, Vec3f arm, Vec3f force) {
    if (body >= place_.size()) return;
    const Vec3f torque = cross(arm, force);
    for (int k = 0; k < 3; k++) {
      entry(body, k) += double(force[k]);
      entry(body, k + 3) += double(torque[k]);
    }
  }

  void assemble(bool tight) {
    tight_.clear();
    matrix_.clear();
    std::fill(rounding_.begin(), rounding_.end(), Rounding());
    for (std::size_t i = 0; i < place_.size(); i++) addBody(matrix_, place_[i], island_.masses[i]);
    auto placeOf = [this](std::uint32_t body) { return body < place_.size() ? place_[body] : kNoPlace; };
    std::as_const(island_.rows).each([&]<class Kind>(const Kind& kind, std::size_t k) {
      StiffReaction x = kind.reactStiff(k, island_.motion.data(), true);
      if (tight) holdTight(kind, k, x);
      addRow(matrix_, kind.ends(k), x, placeOf);
      if constexpr (Kind::kFirm)
        if (!rounding_.empty()) addRounding(rounding_, kind.ends(k), x, island_.motion.data());
    });
    for (std::size_t i = 0; i < island_.locks.size(); i++)
      matrix_.stiffen(place_[i], island_.locks[i], kLockedStiffness);
  }
  void leaveLocked() {
    for (std::size_t i = 0; i < place_.size(); i++)
      for (int k = 0; k < 6; k++)
        if (island_.locks[i] >> k & 1) entry(i, k) = 0;
  }

  // How fast the energy falls along the step. The slope itself falls along the step, and is zero at the minimum.
  double slope() {
    double sum = 0;
    for (std::size_t i = 0; i < place_.size(); i++)
      for (int k = 0; k < 3; k++)
        sum += double(island_.residual[i].force[k]) * entry(i, k) +
               double(island_.residual[i].torque[k]) * entry(i, k + 3);
    return sum;
  }
  double moveTo(double t) {
    for (std::size_t i = 0; i < place_.size(); i++)
      for (int k = 0; k < 3; k++) {
        island_.motion[i].d[k] = float(double(from_[i].d[k]) + t * entry(i, k));
        island_.motion[i].th[k] = float(double(from_[i].th[k]) + t * entry(i, k + 3));
      }
    readForces(false);
    return slope();
  }

  // Bracketed secant search (Illinois rule), every third time halving, until the slope is `share` of the slope at the
  // start.
  void search(double share) {
    double start = slope(), enough = share * start;
    double low = 0, slopeLow = start, high = 1, slopeHigh = moveTo(1), s = slopeHigh;
    for (int k = 0; s > enough && k < 4; k++) {
      low = high;
      slopeLow = s;
      high *= 2;
      s = slopeHigh = moveTo(high);
    }
    for (int k = 0; k < kSearchStepsOfAll && std::fabs(s) > enough && slopeHigh < 0; k++) {
      double t = k % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * slopeLow / (slopeLow - slopeHigh);
      s = moveTo(t);
      (s > 0 ? low : high) = t;
      (s > 0 ? slopeLow : slopeHigh) = s;
      (s > 0 ? slopeHigh : slopeLow) *= 0.5;
    }
  }

  Island& island_;
  SolveStatistics& statistics_;
  std::pmr::vector<std::uint32_t> place_;  // of a body in the matrix
  std::pmr::vector<double> step_;          // by place
  std::pmr::vector<SolveMotion> from_;
  std::pmr::vector<Rounding> rounding_;  // by body; empty without firm ties
  std::pmr::vector<Tight> tight_;
  BlockEnvelope matrix_;
};

}  // namespace

void solveDirectly(Island& island, const StepContext& context, double tolerance, SolveStatistics& statistics) {
  Newton newton(island, statistics);
  Stall stall;
  // Where a row of limits is hit, each of them moves the others. Beside contacts more rounds end in none of them.
  const int rounds = island.facts.jointsAlone() ? kBoundRounds * kBoundRounds : kBoundRounds;
  int boundSolves = 0;
  bool tight = true, again = false;
  for (int k = 0; k < kDirectSteps; k++) {
    const double worst = newton.worst(*context.bodies);
    const int stalled = stall.after(worst);
    // Stalled, ten times the residual is good enough; after twice as many steps a hundred times, if nothing is to rest.
    const double enough = stalled < kStalledSteps ? 1 : stalled < 2 * kStalledSteps || island.plan.slow ? 10 : 100;
    if (worst < enough * tolerance) {
      if (boundSolves++ >= rounds || !newton.settleBounds()) return;
      stall = {};
      again = k > 0 && newton.stiffnessStays();
      k = std::max(k, kMostRenewals);
      tight = !again;
    }
    const double share = stalled < kStalledSteps ? double(kFarFromMinimum) : kEnoughStalled;
    if (!newton.step(k < kMostRenewals, share, tight, again)) return;
    tight = again = false;
    statistics.cycles++;
  }
}

}  // namespace brickfall
