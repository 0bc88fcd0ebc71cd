#include "solver/level_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/imbalance.h"
#include "solver/locks.h"
#include "solver/slope_search.h"

namespace brickfall {

using wide::V;

// The step of a level, and how far along it the island is.
struct LevelWay {
  LevelStep& of;
  const Level& level = of.system_->level();
  float startSlope = float(slope());

  double slope() const {
    double sum = 0;
    for (std::size_t c = 0; c < level.clusters.size(); c++) {
      Wrench now = residualOf(of.island_, level, level.clusters[c]);
      sum += double(dot(now.force, of.step_[c].force) + dot(now.torque, of.step_[c].torque));
    }
    return sum;
  }
  float moveTo(float part) {
    for (std::size_t c = 0; c < level.clusters.size(); c++) {
      const Cluster& cluster = level.clusters[c];
      V way = wide::load(&of.step_[c].force.x) * part, turn = wide::load(&of.step_[c].torque.x) * part;
      V centre = wide::load3(cluster.centre);
      for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
        const std::uint32_t body = level.bodies[k];
        const SolveMotion& from = of.from_[body];
        SolveMotion& m = of.island_.motion[body];
        V arm = wide::load3(of.island_.masses[body].position) - centre;
        wide::store(wide::load(&from.d.x) + (way + wide::cross3(turn, arm)), &m.d.x);
        wide::store(wide::load(&from.th.x) + turn, &m.th.x);
      }
    }
    of.forces_.readAgain();
    return float(slope());
  }
  void goBack() {
    std::copy(of.from_.begin(), of.from_.end(), of.island_.motion.begin());
    of.forces_.readAgain();
  }
  float start() const { return startSlope; }
  float lowest() const { return -kNearMinimum * startSlope; }
  float highest() const { return kFarFromMinimum * startSlope; }
};

LevelStep::LevelStep(RowForces& forces, const Hierarchy& hierarchy, std::size_t level)
    : forces_(forces),
      island_(forces.island()),
      hierarchy_(hierarchy),
      number_(level),
      residuals_(island_.memory),
      step_(island_.memory),
      from_(island_.memory) {}

void LevelStep::findResiduals() {
  const Level& level = system_->level();
  residuals_.clear();
  for (const Cluster& cluster : level.clusters) residuals_.push_back(residualOf(island_, level, cluster));
  keepLocks(residuals_);
}

void LevelStep::keepLocks(Wrenches& wrenches) const {
  if (!anyLocks(island_)) return;
  const Level& level = system_->level();
  for (std::size_t c = 0; c < wrenches.size(); c++) keepFree(wrenches[c], locksOf(island_, level, level.clusters[c]));
}

void LevelStep::apply() {
  if (!system_) system_.emplace(island_, hierarchy_, number_);
  from_.assign(island_.motion.begin(), island_.motion.begin() + std::ptrdiff_t(island_.bodies.size()));
  for (;; valid_ = false) {
    const bool kept = std::exchange(valid_, true);
    if (!kept && !system_->make()) {
      valid_ = false;
      return;
    }
    findResiduals();
    system_->solve(residuals_, step_);
    keepLocks(step_);
    LevelWay way{*this};
    if (!(way.start() > 0)) return;
    const float slope = way.moveTo(1);
    if (slope >= way.lowest()) {
      valid_ = slope <= kNearMinimum * way.start();
      return;
    }
    if (!std::isfinite(slope)) return way.goBack();
    if (!kept) {
      searchAlong(way, slope);
      valid_ = number_ > 0;  // of single bodies, tied firmly: kept, it would mostly go too far again
      return;
    }
    way.goBack();
  }
}

}  // namespace brickfall
