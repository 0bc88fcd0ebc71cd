#include "solver/cycles.h"

#include <algorithm>
#include <limits>

#include "solver/acceleration.h"
#include "solver/cluster_step.h"
#include "solver/imbalance.h"
#include "solver/joint_block.h"
#include "solver/level_step.h"
#include "solver/renewals.h"
#include "solver/slope_search.h"
#include "solver/support.h"

namespace brickfall {

namespace {

//! not of the method: follows from kFarFromMinimum
constexpr float kLessened = kFarFromMinimum * kFarFromMinimum;  // of the residual's square: exact steps in a large
                                                                // island end there, too
//! - | too small: new points slide under friction limits that are not theirs
//! | too large: friction limits and forces chase each other
constexpr int kBoundCycles = 2;  // in which the friction limits of new points follow
//! weights | too small: cost | too large: bodies that are flung about are left unbalanced
constexpr float kMovingWeights = 2.5f;  // x tolerance: what a faster, lightly loaded body may be left with
//! of the strength | too small: cost: a hit on mortar is solved finer than its joints feel
//! | too large: what a solve leaves breaks joints
constexpr float kHeldShare = 0.03f;  // of the weakest of its joints: what a body that mortar holds may be left with
//! - | too small: standing islands are thrown out of balance at their foot
//! | too large: momentum on smooth ground drifts
constexpr float kFree = 0.2f;  // of a force's way without contacts: an island that a force moves further is free
//! of the way of the last velocities | too small: rounding of forces is taken for their change
//! | too large: points open and close on the way
constexpr double kAlongMotion = 0.05;  // so far an island that goes on is moved to find how its forces change

class Relaxation {
 public:
  Relaxation(Island& island, const StepContext& context, SolveStatistics& statistics)
      : island_(island),
        context_(context),
        statistics_(statistics),
        allowed_(island.bodies.size(), 0, island.memory),
        isOut_(island.bodies.size(), 0, island.memory),
        isStale_(island.bodies.size(), 0, island.memory),
        factors_(island.bodies.size(), island.memory),
        exactFactors_(island.bodies.size(), island.memory) {}

  // `renewals`: of what follows the cycles; may be null.
  bool run(Renewals* renewals) {
    forces_.readAll();
    findHold();
    if (island_.plan.goesOn) moveAlong();
    findAllowed();
    bool done = false;
    for (int cycle = 0; goesOn(cycle) && !done; cycle++) {
      statistics_.cycles++;
      bool changed = sweep(cycle);
      // Small islands are read anew, which costs little: under large forces, residuals that only follow are off by
      // their rounding.
      if (!island_.plan.large)
        forces_.readAll();
      else if (cycle < kBoundCycles)
        changed = rowsChanged(forces_.renewBounds()) || changed;
      if (island_.plan.large && island_.facts.partnersGo && (cycle + 1) % island_.plan.minCycles == 0)
        changed = rowsChanged(forces_.holdJams()) || changed;
      countOut();
      // More cycles would find nothing to do.
      const bool idle = island_.plan.large && !changed && out_ == 0;
      done = out_ == 0 && (idle || cycle + 1 - renewed_ >= island_.plan.minCycles);
      if (renewals && (done || (cycle + 1 - renewed_) % island_.plan.renewAfter == 0) &&
          renewals->next(island_, context_, Renewal::within)) {
        renewed_ = cycle + 1;
        done = false;
        forces_.readAll();
        findHold();
        rowsChanged(true);
        countOut();
      }
      if (stalls()) break;
    }
    if (island_.grounded() && !island_.plan.exactSteps && (!island_.plan.slow || slides(island_, context_)))
      moveAsOne();
    // The step of the whole island may have put bodies out of balance.
    allStale_ = true;
    if (done && island_.plan.large) countOut();
    return done && out_ == 0;
  }

 private:
  // Sets each body's allowed residual (N): a body with less is left alone. Standing bodies are judged by their weight,
  // even heavily loaded ones, or bricks would hang at the foot of a wall.
  void findAllowed() {
    forces_.findLoads();
    for (std::size_t i = 0; i < allowed_.size(); i++) allowed_[i] = allowedOf(i);
    if (island_.plan.large) feelResistance();
  }
  float allowedOf(std::size_t i) const {
    const float byWeight = float(island_.plan.tolerance) * float(measure(i).force);
    return i < hold_.size() ? std::max(byWeight, heldShare_ * hold_[i]) : byWeight;
  }
  // What a solve leaves undone is a way that goes as the square of the time. A hit in parts (heavy_hits.h) may so leave
  // the more force in each.
  float heldShare() const { return std::min(kHeldShare / float(context_.part * context_.part), kNearMinimum); }
  // N, by body in a large island: what the weakest joint of mortar on it bears. Its forces follow from places alone, so
  // what a solve leaves is made up in the next step, and joints do not feel it.
  void findHold() {
    if (!island_.plan.large || !island_.rows.anyYielding()) return;
    hold_.assign(allowed_.size(), std::numeric_limits<float>::infinity());
    island_.rows.eachKind([&](const auto& kind) {
      kind.eachHold([&](RowEnds ends, float force) {
        for (std::uint32_t i : {ends.a, ends.b})
          if (i < hold_.size()) hold_[i] = std::min(hold_[i], force);
      });
    });
    for (float& force : hold_)
      if (!(force < std::numeric_limits<float>::infinity())) force = 0;
  }
  // What resists rolling is far below what a large island leaves undone, in every step anew: balls would roll on.
  void feelResistance() {
    resisted_ = false;
    island_.rows.eachKind([&](const auto& kind) {
      kind.eachResistance([&](RowEnds ends, float force) {
        resisted_ = true;
        for (std::uint32_t i : {ends.a, ends.b}) {
          if (i >= allowed_.size()) continue;
          const float rounding = float(kSmallTolerance * measureOf(island_, *context_.bodies, i, kLoadShare).force);
          allowed_[i] = std::min(allowed_[i], std::max(rounding, float(kLeftOver) * force));
        }
      });
    });
  }
  Measure measure(std::size_t i) const {
    if (!island_.plan.large) return measureOf(island_, *context_.bodies, i, 0);
    if (moves(i)) return measureOf(island_, *context_.bodies, i, 1, kMovingWeights);
    return measureOf(island_, *context_.bodies, i, kLoadShare);
  }
  bool moves(std::size_t i) const { return island_.speeds[i] > float(kMovingSpeed); }

  float innerRadius(std::size_t i) const { return float(context_.bodies->mass[island_.bodies[i]].innerRadius); }
  bool balanced(std::size_t i, float share = 1) const {
    const float rounding = island_.plan.direct ? float(kFloatsRound) * island_.loads[i] : 0;
    if (block_.has(std::uint32_t(i)))
      return over(island_.residual[i], {double(allowed_[i]), double(innerRadius(i))}, double(share),
                  block_.rounding(std::uint32_t(i))) <= 1;
    return isWithin(island_.residual[i], std::max(share * allowed_[i], rounding), innerRadius(i));
  }
  // Where single bodies moved, only they and their neighbours are looked at again: most cycles move few of a wall.
  void countOut() {
    if (allStale_ || resisted_ || !island_.plan.large || block_.any()) {
      findAllowed();
      out_ = 0;
      for (std::size_t i = 0; i < allowed_.size(); i++) judge(i);
    } else {
      const Level& level = island_.hierarchy.levels[0];
      for (std::uint32_t i : stale_) {
        forces_.findLoad(level, level.clusters[i], i);
        allowed_[i] = allowedOf(i);
        out_ -= isOut_[i];
        judge(i);
      }
    }
    for (std::uint32_t i : stale_) isStale_[i] = 0;
    stale_.clear();
    allStale_ = false;
  }
  void judge(std::size_t i) {
    isOut_[i] = !balanced(i);
    out_ += isOut_[i];
  }
  // By other than the motion of bodies.
  bool rowsChanged(bool any) {
    allStale_ = allStale_ || any;
    if (any) acceleration_.forget();
    return any;
  }
  // The body was moved: what acts on it and on its neighbours has changed.
  void noteMoved(const Cluster& single, std::uint32_t body) {
    if (allStale_) return;
    auto note = [&](std::uint32_t i) {
      if (i >= isStale_.size() || isStale_[i]) return;
      isStale_[i] = 1;
      stale_.push_back(i);
    };
    note(body);
    const Level& level = island_.hierarchy.levels[0];
    for (std::uint32_t k = single.sideBegin; k < single.sideEnd; k++)
      island_.rows.at(level.sides[k] / 2, [&](const auto& kind, std::size_t index) {
        const RowEnds ends = kind.ends(index);
        note(ends.a);
        note(ends.b);
      });
  }
  // As last counted, and nothing moved near it since.
  bool stillBalanced(std::size_t i) const { return !allStale_ && !isOut_[i] && !isStale_[i]; }
  // Where many bodies are out of balance, the undone motion of a step shakes them in the next ones: more cycles now are
  // fewer then. But they do not begin anew with each renewal: a step in which much breaks makes six.
  bool goesOn(int cycle) const {
    bool many = double(out_) > kLeftOver * double(allowed_.size());
    return cycle - renewed_ < island_.plan.maxCycles || (many && cycle < island_.plan.mostCycles);
  }
  // A cycle of a body alone is all of Newton's method. Where rounding leaves the body out of balance, more cycles
  // change nothing.
  bool stalls() { return island_.plan.alone && stall_.after(double(squareOf(0))) > kStalledSteps; }
  // To compare residuals of one body: a torque counts as a force at its inner radius.
  float squareOf(std::size_t i) const {
    const Wrench& g = island_.residual[i];
    float r = innerRadius(i);
    return dot(g.force, g.force) + dot(g.torque, g.torque) / (r * r);
  }

  bool step(const Level& level, const Cluster& cluster, ClusterFactor& factor, const Wrench& residual, bool exact) {
    ClusterStep made = tryStep(forces_, level, cluster, factor, residual, exact);
    if (made.part == 0) return false;
    forces_.acceptBoundary(level, cluster);
    addInertiaOfStep(island_, level, cluster, made);
    return true;
  }

  // Moves all clusters at once, then the bodies one by one. In islands of few bodies the direct solve that follows does
  // the first. True if any body was moved.
  bool sweep(int cycle) {
    const bool large = island_.plan.large, few = island_.plan.direct && island_.plan.exactSteps;
    const bool together = !few && island_.hierarchy.levels.size() > 1 && (!large || cycle == 0 || worthReading_);
    bool moved = large && worthReading_;
    if (moved) acceleration_.apply(forces_);
    if (large) acceleration_.begin();
    if (together && clustersOut()) {
      together_.apply();
      moved = true;
    }
    allStale_ = allStale_ || moved || block_.any();
    const std::size_t before = forces_.sidesRead();
    const int rounds = few ? 1 : island_.plan.rounds;
    for (int round = 0; round < rounds; round++) {
      bool any = !block_.balanced(*context_.bodies) && block_.apply();
      any = (round == 0 && block_.any() && block_.follow()) || any;
      any = singleSweep(round % 2 != 0) || any;
      if (!any) break;
      moved = moved || block_.any();
    }
    if (large) allStale_ ? acceleration_.end() : acceleration_.end(stale_);
    const std::size_t sides = forces_.sidesRead() - before;
    worthReading_ = sides > island_.rows.size();
    return moved || sides > 0;
  }

  // Whether a cluster is out of balance. (What a single body may be left with can be more than the weight of all.)
  bool clustersOut() const {
    const Level& level = island_.hierarchy.levels[1];
    return std::any_of(level.clusters.begin(), level.clusters.end(), [&](const Cluster& cluster) {
      return !isWithin(residualOf(island_, level, cluster), measureOf(island_, level, cluster, 0),
                       island_.plan.tolerance);
    });
  }

  // True if any body was out of balance.
  bool singleSweep(bool backwards) {
    const Level& level = island_.hierarchy.levels[0];
    std::size_t count = level.clusters.size();
    bool any = false;
    for (std::size_t n = 0; n < count; n++) {
      std::size_t c = backwards ? count - 1 - n : n;
      const Cluster& cluster = level.clusters[c];
      std::uint32_t body = level.bodies[cluster.bodyBegin];
      if (cluster.sideBegin == cluster.sideEnd || stillBalanced(body) || balanced(body) || block_.has(body)) continue;
      any = true;
      noteMoved(cluster, body);
      solveBody(level, cluster, factors_[c], body);
    }
    return any;
  }

  // A standing body takes a step that counts near points as closed. It takes exact steps only if that step found hardly
  // any way: then it hangs by open points. A moving body takes exact steps at once. They end well within what it may be
  // left with, those of small islands at a trifle of it.
  void solveBody(const Level& level, const Cluster& cluster, ClusterFactor& factor, std::uint32_t body) {
    if (!island_.plan.exactSteps && !moves(body)) {
      float before = squareOf(body);
      step(level, cluster, factor, island_.residual[body], false);
      if (balanced(body, 0.5f) || squareOf(body) < kLessened * before) return;
    }
    float goal = island_.plan.exactSteps ? float(kTrifle) : kNearMinimum;
    float enough = island_.plan.exactSteps ? 0 : kLessened * squareOf(body);
    for (int k = 0; k < kStalledSteps && !balanced(body, goal) && (k == 0 || squareOf(body) > enough); k++) {
      if (!step(level, cluster, exactFactors_[body], island_.residual[body], true)) break;
    }
  }

  // Where nothing holds an island, its own motion is a way that contacts leave open: a plate rolls on a hundred balls.
  // No cluster moves so, and on each body alone the force may be under what counts as balance, but all of them together
  // lag. So the island first moves along its motion to where no force along it is left.
  void moveAlong() {
    acceleration_.begin();
    const double part = kAlongMotion * island_.dt;
    for (std::size_t i = 0; i < allowed_.size(); i++) {
      const BodyMotion& m = context_.bodies->motion[island_.bodies[i]];
      island_.motion[i].d += toFloat(m.linearVelocity * part);
      island_.motion[i].th += toFloat(m.angularVelocity * part);
    }
    forces_.readAgain();
    acceleration_.end();
    acceleration_.apply(forces_);
  }

  // On smooth ground the island as a whole takes one exact Newton step, which makes its momentum exact. Not where
  // friction holds it, where the step would only load the bodies at its foot; nor while it is slow and does not slide.
  void moveAsOne() {
    const Level& top = island_.hierarchy.levels.back();
    for (const Cluster& cluster : top.clusters) {
      if (cluster.sideBegin == cluster.sideEnd) continue;
      ClusterFactor exact{clusterMatrix(forces_, top, cluster, true)};
      if (!(exact.valid = exact.matrix.factor())) continue;
      if (freest(exact.matrix) * cluster.mass > kFree)
        step(top, cluster, exact, residualOf(island_, top, cluster), true);
    }
  }
  // m/N: how far a force along x, y or z moves the island at most.
  static float freest(const Symmetric6& factor) {
    return std::max({factor.solve({{1, 0, 0}, {}}).force.x, factor.solve({{0, 1, 0}, {}}).force.y,
                     factor.solve({{0, 0, 1}, {}}).force.z});
  }

  Island& island_;
  const StepContext& context_;
  SolveStatistics& statistics_;
  RowForces forces_{island_, statistics_};
  Acceleration acceleration_{island_};
  LevelStep together_{forces_, island_.hierarchy, island_.plan.together};
  JointBlock block_{forces_};
  std::pmr::vector<float> allowed_;               // N, by body
  std::pmr::vector<float> hold_{island_.memory};  // N, by body; empty without mortar
  const float heldShare_ = heldShare();
  Stall stall_;                                            // of a body alone
  int renewed_ = 0;                                        // the cycle after which what is frozen was last set anew
  std::size_t out_ = 0;                                    // bodies out of balance
  std::pmr::vector<std::uint8_t> isOut_;                   // by body, as last counted
  std::pmr::vector<std::uint8_t> isStale_;                 // by body: in `stale_`
  std::pmr::vector<std::uint32_t> stale_{island_.memory};  // bodies on which forces have changed since
  bool allStale_ = true;                                   // since that, on any
  bool resisted_ = false;                                  // rows resist rolling
  bool worthReading_ = false;                              // the last cycle moved enough to read all rows again
  std::pmr::vector<ClusterFactor> factors_;                // by body
  std::pmr::vector<ClusterFactor> exactFactors_;           // by body, of exact steps
};

}  // namespace

bool relax(Island& island, const StepContext& context, SolveStatistics& statistics, Renewals* renewals) {
  return Relaxation(island, context, statistics).run(island.plan.renewAfter > 0 ? renewals : nullptr);
}

}  // namespace brickfall
