#include "solver/row_forces.h"

#include <algorithm>

#include "solver/light_pass.h"

namespace brickfall {

using wide::V;

void RowForces::take(std::uint32_t row, RowEnds ends, Arms arms, Reading now) {
  Reading& old = readings_[row];
  addTo(island_.residual.data(), bodies_, ends, arms, now.force - old.force, now.torque - old.torque);
  if (anyLocks(island_)) keepFree(island_, ends);
  old = now;
}

void RowForces::readAll() {
  following_.clear();
  std::uint32_t row = 0;
  island_.rows.each([&](auto& kind, std::size_t k) {
    kind.renewBounds(k, island_.motion.data(), 0, false);
    if (kind.boundsFollow(k)) following_.push_back(row);
    row++;
  });
  readAgain();
}

void RowForces::readAgain() {
  readResiduals(island_, statistics_.lightVisits, readings_.data(), [](RowEnds, const Reading&) {});
}

template <class Kind> void RowForces::readRow(std::uint32_t row, const Kind& kind, std::size_t index) {
  const Reaction now = kind.react(index, island_.motion.data());
  take(row, kind.ends(index), {now.armA, now.armB}, {now.force, now.torque});
}

void RowForces::readRows(const std::pmr::vector<std::uint32_t>& rows) {
  for (std::uint32_t row : rows)
    island_.rows.at(row, [&](const auto& kind, std::size_t index) {
      statistics_.lightVisits += kind.kPoints;
      readRow(row, kind, index);
    });
}

bool RowForces::settle(std::uint32_t row) {
  bool any = false;
  island_.rows.at(row, [&](auto& kind, std::size_t index) {
    any = kind.renewBounds(index, island_.motion.data(), 0, true);
    if (any) readRow(row, kind, index);
  });
  return any;
}

bool RowForces::renewBounds() {
  bool any = false;
  for (std::uint32_t row : following_)
    island_.rows.at(row, [&](auto& kind, std::size_t index) {
      if (!kind.renewBounds(index, island_.motion.data(), float(kTrifle), false)) return;
      any = true;
      statistics_.lightVisits += kind.kPoints;
      readRow(row, kind, index);
    });
  return any;
}

bool RowForces::holdJams() {
  bool any = false;
  std::uint32_t row = 0;
  island_.rows.each([&](auto& kind, std::size_t index) {
    const std::uint32_t now = row++;
    if (!kind.holdJam(index, island_.motion.data(), length(wide::store3(readings_[now].force)))) return;
    any = true;
    statistics_.lightVisits += kind.kPoints;
    readRow(now, kind, index);
  });
  return any;
}

void RowForces::acceptBoundary(const Level& level, const Cluster& cluster) {
  const Reading* trial = trial_.data();
  for (std::uint32_t k = cluster.sideBegin; k < cluster.sideEnd; k++, trial++) {
    const std::uint32_t row = level.sides[k] / 2;
    island_.rows.at(row, [&](const auto& kind, std::size_t i) { take(row, kind.ends(i), kind.arms(i), *trial); });
  }
}

void RowForces::findLoads() {
  island_.loads.assign(bodies_, 0);
  std::uint32_t row = 0;
  island_.rows.each([&](const auto& kind, std::size_t k) { addLoad(island_, kind.ends(k), readings_[row++]); });
}

// In the order of rows, as findLoads adds them.
void RowForces::findLoad(const Level& level, const Cluster& single, std::uint32_t body) {
  float load = 0;
  for (std::uint32_t k = single.sideBegin; k < single.sideEnd; k++) load += halfOf(readings_[level.sides[k] / 2]);
  island_.loads[body] = load;
}

// Sides are in the order of their rows, so sides of one kind follow each other.
Wrench RowForces::readBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* matrix) {
  trial_.resize(cluster.sideEnd - cluster.sideBegin);
  Boundary part;
  part.sides = level.sides.data() + cluster.sideBegin;
  part.motion = island_.motion.data();
  part.masses = island_.masses.data();
  part.readings = readings_.data();
  part.trial = trial_.data();
  part.centre = wide::load3(cluster.centre);
  part.single = cluster.bodyEnd - cluster.bodyBegin == 1;
  part.exact = exact;
  const std::uint32_t* end = level.sides.data() + cluster.sideEnd;
  BoundarySums sums;
  sums.matrix = matrix;
  island_.rows.eachKind([&](const auto& kind) {
    if (kind.size() == 0) return;
    const std::uint32_t endRow = part.firstRow + std::uint32_t(kind.size());
    const std::uint32_t* stop = Rows::kKinds == 1 ? end : std::lower_bound(part.sides, end, 2 * endRow);
    part.count = std::uint32_t(stop - part.sides);
    if (part.count > 0) kind.sumBoundary(part, sums);
    statistics_.solveSides += kind.kPoints * part.count;
    part.sides = stop;
    part.trial += part.count;
    part.firstRow = endRow;
  });
  sidesRead_ += cluster.sideEnd - cluster.sideBegin;
  return {wide::store3(sums.force), wide::store3(sums.torque)};
}

}  // namespace brickfall
