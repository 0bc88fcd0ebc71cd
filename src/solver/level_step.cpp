#include "solver/level_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/cluster_step.h"
#include "solver/imbalance.h"
#include "solver/locks.h"
#include "solver/slope_search.h"

namespace brickfall {

// The step of a level, and how far along it the island is.
struct LevelWay {
  LevelStep& of;
  const Level& level = of.system_->level();
  float startSlope = float(slope());

  double slope() const {
    double sum = 0;
    for (std::size_t c = 0; c < level.clusters.size(); c++)
      sum += double(power(residualOf(of.island_, level, level.clusters[c]), of.step_[c]));
    return sum;
  }
  float moveTo(float part) {
    for (std::size_t c = 0; c < level.clusters.size(); c++)
      moveCluster(of.island_, level, level.clusters[c], of.step_[c], part, of.from_.data());
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
