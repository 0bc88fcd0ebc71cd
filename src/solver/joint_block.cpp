#include "solver/joint_block.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "solver/joint/swings.h"
#include "solver/locks.h"
#include "solver/slope_search.h"

namespace brickfall {

JointBlock::JointBlock(RowForces& forces) : island_(forces.island()), forces_(forces) {
  if (!island_.plan.large || !island_.facts.jointed) return;
  kinks_ = hasBounds(island_);
  findBodies();
  findRows();
}

// In places that make the envelope narrow, and in their order.
void JointBlock::findBodies() {
  const std::size_t own = island_.bodies.size();
  newton_.place.assign(own, kNoPlace);
  auto enter = [&](std::uint32_t body) {
    if (body < own && !has(body)) newton_.enter(body);
  };
  island_.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if constexpr (std::remove_cvref_t<Kind>::kLasts) {
      enter(kind.ends(k).a);
      enter(kind.ends(k).b);
    }
  });
  enterLoads();
  newton_.findPlaces();
  std::sort(newton_.bodies.begin(), newton_.bodies.end(),
            [this](std::uint32_t a, std::uint32_t b) { return newton_.place[a] < newton_.place[b]; });
}

// What lies on a jointed body and is heavier moves with it: one after the other, the two would take turns for ever.
void JointBlock::enterLoads() {
  const std::size_t own = island_.bodies.size(), jointed = newton_.bodies.size();
  auto enter = [&](std::uint32_t load, std::uint32_t under) {
    const bool onJointed = newton_.place[under] < jointed;
    if (onJointed && !has(load) && island_.masses[load].mass > island_.masses[under].mass) newton_.enter(load);
  };
  island_.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (ends.a >= own || ends.b >= own) return;
    enter(ends.a, ends.b);
    enter(ends.b, ends.a);
  });
}

void JointBlock::findRows() {
  std::uint32_t row = 0;
  island_.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (has(ends.a) || has(ends.b)) rows_.push_back(row);
    if (std::remove_cvref_t<Kind>::kLasts) lasting_.push_back(row);
    row++;
  });
}

bool JointBlock::factor() {
  newton_.beginMatrix();
  for (std::uint32_t row : rows_)
    std::as_const(island_.rows).at(row, [&](const auto& kind, std::size_t k) {
      newton_.add(kind, k, kind.reactStiff(k, island_.motion.data(), Resist::exactly));
    });
  return newton_.factor();
}

// Returns the slope along the step.
double JointBlock::findStep() {
  newton_.takeResiduals();
  newton_.solve();
  return newton_.slope();
}

void JointBlock::addInertias(float sign) {
  for (std::uint32_t body : newton_.bodies) {
    const Wrench of = inertiaResidual(island_.masses[body], island_.motion[body]);
    island_.residual[body].force += of.force * sign;
    island_.residual[body].torque += of.torque * sign;
    if (anyLocks(island_)) keepFree(island_.residual[body], island_.locks[body]);
  }
}

// Returns the slope there.
double JointBlock::moveTo(double part) {
  addInertias(-1);
  newton_.moveBodies(part);
  addInertias(1);
  forces_.readRows(rows_);
  return newton_.slope();
}

bool JointBlock::balanced(const BodySet& bodies) const {
  return std::all_of(newton_.bodies.begin(), newton_.bodies.end(), [&](std::uint32_t body) {
    return over(island_.residual[body], measureOf(island_, bodies, body, kHeavyLoad), kSmallTolerance,
                rounding(body)) <= 1;
  });
}

bool JointBlock::apply() {
  double start = last_ > 0 ? findStep() : 0;
  if (!(start > 0) || start > double(kFarFromMinimum) * last_) {
    last_ = 0;
    if (!factor()) return false;
    start = findStep();
  }
  if (!(start > 0)) return false;
  last_ = start;
  newton_.begin();
  auto go = [this](double part) { return moveTo(part); };
  if (kinks_)
    searchOverKinks(start, double(kNearMinimum), 0, kSearchSteps, go);
  else
    searchAlong(start, double(kNearMinimum), 0, kSearchSteps, go);
  return true;
}

bool JointBlock::follow() {
  bool any = false;
  addInertias(-1);  // geometric stiffness may grow
  for (std::uint32_t row : lasting_) any = forces_.settle(row) || any;
  addInertias(1);
  return any;
}

}  // namespace brickfall
