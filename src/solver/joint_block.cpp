#include "solver/joint_block.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "solver/body_matrix.h"
#include "solver/locks.h"
#include "solver/numbering.h"
#include "solver/slope_search.h"

namespace brickfall {

JointBlock::JointBlock(RowForces& forces)
    : island_(forces.island()),
      forces_(forces),
      place_(island_.memory),
      bodies_(island_.memory),
      rows_(island_.memory),
      lasting_(island_.memory),
      step_(island_.memory),
      from_(island_.memory),
      rounding_(island_.memory),
      matrix_(island_.memory) {
  if (!island_.plan.large || !island_.facts.jointed) return;
  findBodies();
  findRows();
}

// The bodies, in places that make the envelope narrow.
void JointBlock::findBodies() {
  const std::size_t own = island_.bodies.size();
  place_.assign(own, kNoIndex);
  auto enter = [&](std::uint32_t body) {
    if (body >= own || place_[body] != kNoIndex) return;
    place_[body] = std::uint32_t(bodies_.size());
    bodies_.push_back(body);
  };
  island_.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if constexpr (std::remove_cvref_t<Kind>::kLasts) {
      enter(kind.ends(k).a);
      enter(kind.ends(k).b);
    }
  });
  enterLoads();
  Adjacency near(island_.memory);
  near.fill(std::uint32_t(bodies_.size()), [&](auto visit) {
    std::as_const(island_.rows).each([&](const auto& kind, std::size_t k) {
      const RowEnds ends = kind.ends(k);
      if (ends.a < own && ends.b < own && has(ends.a) && has(ends.b)) visit(place_[ends.a], place_[ends.b]);
    });
  });
  const auto places = nearPlaces(near);
  matrix_.shape(lowestPlaces(near, places));
  const std::pmr::vector<std::uint32_t> found(bodies_, island_.memory);
  for (std::size_t i = 0; i < found.size(); i++) {
    bodies_[places[i]] = found[i];
    place_[found[i]] = places[i];
  }
  step_.resize(6 * bodies_.size());
}

// What lies on a jointed body and is heavier moves with it: one after the other, the two would take turns for ever.
void JointBlock::enterLoads() {
  const std::size_t own = island_.bodies.size(), jointed = bodies_.size();
  auto isJointed = [&](std::uint32_t body) { return place_[body] < jointed; };
  auto enter = [&](std::uint32_t load, std::uint32_t under) {
    if (!isJointed(under) || place_[load] != kNoIndex || !(island_.masses[load].mass > island_.masses[under].mass))
      return;
    place_[load] = std::uint32_t(bodies_.size());
    bodies_.push_back(load);
  };
  island_.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (ends.a >= own || ends.b >= own) return;
    enter(ends.a, ends.b);
    enter(ends.b, ends.a);
  });
}

void JointBlock::findRows() {
  const std::size_t own = island_.bodies.size();
  std::uint32_t row = 0;
  island_.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if ((ends.a < own && has(ends.a)) || (ends.b < own && has(ends.b))) rows_.push_back(row);
    if (std::remove_cvref_t<Kind>::kLasts) lasting_.push_back(row);
    row++;
  });
}

void JointBlock::assemble() {
  matrix_.clear();
  rounding_.assign(place_.size(), Rounding());
  for (std::uint32_t i = 0; i < bodies_.size(); i++) addBody(matrix_, i, island_.masses[bodies_[i]]);
  auto placeOf = [this](std::uint32_t body) { return body < place_.size() ? place_[body] : kNoIndex; };
  for (std::uint32_t row : rows_)
    std::as_const(island_.rows).at(row, [&]<class Kind>(const Kind& kind, std::size_t k) {
      const StiffReaction x = kind.reactStiff(k, island_.motion.data(), true);
      addRow(matrix_, kind.ends(k), x, placeOf);
      if constexpr (Kind::kFirm) addRounding(rounding_, kind.ends(k), x, island_.motion.data());
    });
  if (!anyLocks(island_)) return;
  for (std::uint32_t i = 0; i < bodies_.size(); i++) matrix_.stiffen(i, island_.locks[bodies_[i]], kLockedStiffness);
}

// How fast the energy falls along the step.
double JointBlock::slope() const {
  double sum = 0;
  for (std::size_t i = 0; i < bodies_.size(); i++)
    for (int k = 0; k < 3; k++)
      sum += double(island_.residual[bodies_[i]].force[k]) * step_[6 * i + std::size_t(k)] +
             double(island_.residual[bodies_[i]].torque[k]) * step_[6 * i + 3 + std::size_t(k)];
  return sum;
}

void JointBlock::addInertias(float sign) {
  for (std::uint32_t body : bodies_) {
    const Wrench of = inertiaResidual(island_.masses[body], island_.motion[body]);
    island_.residual[body].force += of.force * sign;
    island_.residual[body].torque += of.torque * sign;
    if (anyLocks(island_)) keepFree(island_.residual[body], island_.locks[body]);
  }
}

// Returns the slope there.
double JointBlock::moveTo(double part) {
  addInertias(-1);
  for (std::size_t i = 0; i < bodies_.size(); i++) {
    SolveMotion& m = island_.motion[bodies_[i]];
    for (int k = 0; k < 3; k++) {
      m.d[k] = float(double(from_[i].d[k]) + part * step_[6 * i + std::size_t(k)]);
      m.th[k] = float(double(from_[i].th[k]) + part * step_[6 * i + 3 + std::size_t(k)]);
    }
  }
  addInertias(1);
  forces_.readRows(rows_);
  return slope();
}

void JointBlock::search(double start) {
  double low = 0, slopeLow = start, high = 1, slopeHigh = moveTo(1), s = slopeHigh;
  for (int k = 0; k < kSearchSteps && slopeHigh < 0 && std::fabs(s) > double(kNearMinimum) * start; k++) {
    const double part = k % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * slopeLow / (slopeLow - slopeHigh);
    s = moveTo(part);
    (s > 0 ? low : high) = part;
    (s > 0 ? slopeLow : slopeHigh) = s;
    (s > 0 ? slopeHigh : slopeLow) *= 0.5;
  }
}

bool JointBlock::factor() {
  assemble();
  return matrix_.factor();
}

void JointBlock::findStep() {
  for (std::size_t i = 0; i < bodies_.size(); i++)
    for (int k = 0; k < 3; k++) {
      step_[6 * i + std::size_t(k)] = double(island_.residual[bodies_[i]].force[k]);
      step_[6 * i + 3 + std::size_t(k)] = double(island_.residual[bodies_[i]].torque[k]);
    }
  matrix_.solve(step_.data());
  for (std::size_t i = 0; anyLocks(island_) && i < bodies_.size(); i++)
    for (std::size_t k = 0; k < 6; k++)
      if (island_.locks[bodies_[i]] >> k & 1) step_[6 * i + k] = 0;
}

bool JointBlock::balanced(const BodySet& bodies) const {
  return std::all_of(bodies_.begin(), bodies_.end(), [&](std::uint32_t body) {
    return over(island_.residual[body], measureOf(island_, bodies, body, kHeavyLoad), kSmallTolerance,
                rounding(body)) <= 1;
  });
}

bool JointBlock::apply() {
  double start = 0;
  if (last_ > 0) {
    findStep();
    start = slope();
  }
  if (!(start > 0) || start > double(kFarFromMinimum) * last_) {
    last_ = 0;
    if (!factor()) return false;
    findStep();
    start = slope();
  }
  if (!(start > 0)) return false;
  last_ = start;
  from_.clear();
  for (std::uint32_t body : bodies_) from_.push_back(island_.motion[body]);
  search(start);
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
