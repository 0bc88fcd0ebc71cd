// With the friction limits frozen the step is the minimum of a strictly convex energy: Newton with a search along each
// step converges from anywhere. In an island of some dozens of bodies a factor costs about as much as a few cycles.
#include "solver/cycles.h"

#include <algorithm>
#include <utility>

#include "solver/body_newton.h"
#include "solver/joint/round.h"
#include "solver/joint/swings.h"
#include "solver/light_pass.h"
#include "solver/renewals.h"
#include "solver/slope_search.h"

namespace brickfall {

namespace {

// Half of all solves are done after 1 step, 99 % after 45, all after 51: scene `wall`, its rubble.
//! - | too small: rubble is left with many weights unbalanced | too large: cost of rubble
constexpr int kDirectSteps = 100;
//! - | too small: cost | too large: steps jump to and fro over edges that open and close: chains that snap gain
constexpr double kEnoughStalled = 0.1;  // the same after kStalledSteps

class Newton {
 public:
  Newton(Island& island, bool limits, SolveStatistics& statistics)
      : island_(island), limits_(limits), statistics_(statistics), newton_(island), tight_(island.memory) {
    newton_.place.resize(island.bodies.size());
    for (std::uint32_t i = 0; i < island.bodies.size(); i++) newton_.enter(i);
    newton_.findPlaces();
  }

  struct How {
    double enough;      // of the slope at its start: how near to the minimum along it a step ends
    bool boundsFollow;  // friction limits of new points do
    bool tight;    // ropes that are slack by less than their ends go in this time step count as tight, for a row of
                   // them that snaps would close one by one
    bool again;    // by the last matrix, which is nearly that of now
    bool secants;  // what slides resists by its secant
  };
  // Finds a step. False if the matrix is not positive definite.
  bool find(const How& how) {
    if (how.again)
      solve();
    else if (!findStep(how.tight, how.secants))
      return false;
    return tight_.empty() || newton_.slope() > 0 || findStep(false, how.secants);
  }
  // Beside contacts a round takes many steps, which the next would undo, and steps run out. So a round ends where what
  // the step found would still gain is little beside what joints would still do. Multipliers follow, and the step.
  void endRound() {
    if (!endsRound(newton_.slope(), island_)) return;
    bool any = false;
    island_.rows.each([&]<class Kind>(Kind& kind, std::size_t k) {
      if constexpr (Kind::kLasts) any = settle(kind, k) || any;
    });
    if (!any) return;
    readForces(false);
    solve();
  }
  // Goes to about the minimum of the energy along the step.
  void go(const How& how) {
    newton_.begin();
    auto moveTo = [this](double part) {
      newton_.moveBodies(part);
      readForces(false);
      return newton_.slope();
    };
    if (limits_)
      searchOverKinks(newton_.slope(), how.enough, 4, kSearchStepsOfAll, moveTo);
    else
      searchAlong(newton_.slope(), how.enough, 4, kSearchStepsOfAll, moveTo);
    if (how.boundsFollow && !island_.facts.jointsAlone()) readForces(true);
  }
  // Of joints alone, what was frozen changes forces, and stiffness next to nothing: but which bounds are reached.
  bool stiffnessStays() const { return island_.facts.jointsAlone() && !hasBounds(island_); }

  // The largest residual over its body's measure, which counts what floats round.
  double worst(const BodySet& bodies) const {
    if (newton_.rounding.empty()) return worstResidual(island_, bodies);
    const double share = island_.plan.tolerance;
    double worst = 0;
    for (std::size_t i = 0; i < island_.bodies.size(); i++)
      takeLarger(worst,
                 over(island_.residual[i], measureOf(island_, bodies, i, kHeavyLoad), share, newton_.rounding[i]));
    return share * worst;
  }

  // Sets the friction limits of new points by the forces that were found, and the multipliers of joints. True if any
  // changed.
  bool settleBounds() {
    bool any = false;
    island_.rows.each([&](auto& kind, std::size_t k) { any = settle(kind, k) || any; });
    if (any) readForces(false);
    return any;
  }
  // The motion, and what joints keep frozen, are those of an earlier round.
  void goOnFrom(const JointRound& round) {
    round.restore(island_);
    island_.rows.each([&]<class Kind>(Kind& kind, std::size_t k) {
      if constexpr (!Kind::kLasts) settle(kind, k);
    });
    readForces(false);
  }

 private:
  template <class Kind> bool settle(Kind& kind, std::size_t k) {
    return kind.boundsFollow(k) && kind.renewBounds(k, island_.motion.data(), float(kTrifle), true);
  }
  void readForces(bool boundsFollow) { lightPass(island_, boundsFollow, statistics_.lightVisits); }

  bool findStep(bool tight, bool secants) {
    tight_.clear();
    newton_.beginMatrix();
    std::as_const(island_.rows).each([&](const auto& kind, std::size_t k) {
      StiffReaction x = kind.reactStiff(k, island_.motion.data(), secants ? Resist::bySecants : Resist::exactly);
      if (tight) holdTight(kind, k, x);
      newton_.add(kind, k, x);
    });
    if (!newton_.factor()) return false;
    solve();
    return true;
  }
  void solve() {
    newton_.takeResiduals();
    for (const Tight& rope : tight_) {
      pull(rope.ends.a, rope.armA, -rope.force);
      pull(rope.ends.b, rope.armB, rope.force);
    }
    newton_.solve();
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
      if (newton_.has(body)) reach += length(island_.motion[body].d);
    if (!(push > 0 && push < r.way.k[0] * reach)) return;
    const wide::V axis = wide::load(&r.way.axes[0].unit.x);
    for (int i = 0; i < 3; i++) x.stiffness.A[i] += axis * (r.way.k[0] * axis[i]);  // floats round by it
    BodyBlock K = {};
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) K[i][j] = double(r.way.k[0]) * (double(axis[i]) * double(axis[j]));
    newton_.addRow(joints.ends(k), x, K);
    tight_.push_back({joints.ends(k), wide::store3(x.armA), wide::store3(x.armB), r.way.axes[0].unit * push});
  }
  void pull(std::uint32_t body, Vec3f arm, Vec3f force) {
    if (!newton_.has(body)) return;
    const Vec3f torque = cross(arm, force);
    for (int k = 0; k < 3; k++) {
      newton_.entry(body, k) += double(force[k]);
      newton_.entry(body, k + 3) += double(torque[k]);
    }
  }

  Island& island_;
  bool limits_;  // some joint has a limit or is a rope
  SolveStatistics& statistics_;
  BodyNewton newton_;
  std::pmr::vector<Tight> tight_;
};

// Some body turns so far that arcs count.
bool turnsFar(const Island& island) {
  const std::size_t own = island.bodies.size();
  return std::any_of(island.motion.begin(), island.motion.begin() + std::ptrdiff_t(own),
                     [](const SolveMotion& m) { return length(m.th) > float(kTrifle); });
}

// Offers each round from the third on to `nearest`.
void solveInRounds(Island& island, const StepContext& context, double tolerance, Newton& newton, JointRound& nearest,
                   SolveStatistics& statistics) {
  Stall stall;
  // Where a row of limits is hit, each of them moves the others; what turns far has another arc in each round. Beside
  // contacts a solve in the midst of which steps run out is worse than one round less.
  auto mayFollow = [&](int round, int k) {
    if (round < kBoundRounds) return true;
    return round < kBoundRounds * kBoundRounds &&
           (island.facts.jointsAlone() || (island.plan.endVelocities && k < kDirectSteps / 2 && turnsFar(island)));
  };
  int boundSolves = 0;
  bool tight = true, again = false;
  for (int k = 0; k < kDirectSteps; k++) {
    const double worst = newton.worst(*context.bodies);
    const int stalled = stall.after(worst);
    // Stalled, ten times the residual is good enough; after twice as many steps a hundred times.
    const bool stuck = stalled >= kStalledSteps;
    const double enough = !stuck ? 1 : stalled < 2 * kStalledSteps ? 10 : 100;
    const bool done = worst < enough * tolerance;
    const bool joints = island.facts.jointed;
    if (done && joints && boundSolves + 1 >= kBoundRounds && !nearest.offer(island)) return;
    if (done) {
      if (!mayFollow(boundSolves, k) || !newton.settleBounds()) return;
      boundSolves++;
      stall = {};
      again = k > 0 && newton.stiffnessStays();
      k = std::max(k, kMostRenewals);
      tight = !again;
    }
    // Rounds of joints' multipliers need the end of a solve, which secants near too slowly: their searches go nearer.
    const double share = stuck && joints ? kEnoughStalled : double(kFarFromMinimum);
    const Newton::How how{share, k < kMostRenewals, tight, again, stuck && !joints};
    if (!newton.find(how)) return;
    if (joints && !island.facts.jointsAlone()) newton.endRound();
    newton.go(how);
    tight = again = false;
    statistics.cycles++;
  }
}

}  // namespace

void solveDirectly(Island& island, const StepContext& context, double tolerance, SolveStatistics& statistics) {
  Newton newton(island, island.plan.endVelocities && hasBounds(island), statistics);
  JointRound nearest(island.memory);
  solveInRounds(island, context, tolerance, newton, nearest, statistics);
  if (nearest.isLeft(island)) newton.goOnFrom(nearest);
}

}  // namespace brickfall
