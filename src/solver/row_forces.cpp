#include "solver/row_forces.h"

namespace brickfall {

using wide::V;

void RowForces::add(RowEnds ends, const Reaction& at, V force, V torque) {
  if (ends.a < bodies_) {
    Wrench& r = island_.residual[ends.a];
    wide::store(wide::load(&r.force.x) - force, &r.force.x);
    wide::store(wide::load(&r.torque.x) - (wide::cross3(at.armA, force) + torque), &r.torque.x);
  }
  if (ends.b < bodies_) {
    Wrench& r = island_.residual[ends.b];
    wide::store(wide::load(&r.force.x) + force, &r.force.x);
    wide::store(wide::load(&r.torque.x) + (wide::cross3(at.armB, force) + torque), &r.torque.x);
  }
}

void RowForces::take(std::uint32_t row, RowEnds ends, const Reaction& now) {
  Reading& old = readings_[row];
  add(ends, now, now.force - old.force, now.torque - old.torque);
  old = {now.force, now.torque};
}

void RowForces::readAll() {
  island_.residual.resize(bodies_);
  for (std::uint32_t i = 0; i < bodies_; i++)
    island_.residual[i] = inertiaResidual(island_.masses[i], island_.motion[i]);
  following_.clear();
  std::uint32_t row = 0;
  island_.rows.each([&](auto& kind, std::size_t k) {
    kind.renewBounds(k, island_.motion.data(), 0);
    if (kind.boundsFollow(k)) following_.push_back(row);
    Reaction now = kind.react(k, island_.motion.data());
    add(kind.ends(k), now, now.force, now.torque);
    readings_[row++] = {now.force, now.torque};
    statistics_.lightVisits += kind.kPoints;
  });
}

void RowForces::renewBounds() {
  changeBounds(
      [this](auto& kind, std::uint32_t index) { return kind.renewBounds(index, island_.motion.data(), kBoundSlack); });
}

void RowForces::acceptBoundary(const Level& level, const Cluster& cluster) {
  for (std::uint32_t k = cluster.sideBegin; k < cluster.sideEnd; k++) {
    std::uint32_t row = level.sides[k] / 2;
    island_.rows.at(row, [&](const auto& kind, std::uint32_t index) {
      take(row, kind.ends(index), trial_[k - cluster.sideBegin]);
    });
  }
}

void RowForces::findLoads() {
  island_.loads.assign(bodies_, 0);
  std::uint32_t row = 0;
  island_.rows.each([&](const auto& kind, std::size_t k) {
    float half = 0.5f * length(wide::store3(readings_[row++].force));
    RowEnds ends = kind.ends(k);
    if (ends.a < bodies_) island_.loads[ends.a] += half;
    if (ends.b < bodies_) island_.loads[ends.b] += half;
  });
}

template <bool withMatrix>
Wrench RowForces::sumBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* sums) {
  bool single = cluster.bodyEnd - cluster.bodyBegin == 1;
  V centre = wide::load3(cluster.centre), force = wide::set(0), torque = wide::set(0);
  for (std::uint32_t k = cluster.sideBegin; k < cluster.sideEnd; k++) {
    std::uint32_t side = level.sides[k], row = side / 2;
    // Rows lie in the order of their pairs, clusters jump about in it.
    if (k + 2 < cluster.sideEnd)
      island_.rows.at(level.sides[k + 2] / 2, [](const auto& kind, std::uint32_t index) { kind.prefetch(index); });
    island_.rows.at(row, [&](const auto& kind, std::uint32_t index) {
      Reaction& x = trial_[k - cluster.sideBegin];
      [[maybe_unused]] Stiffness stiffness;
      if constexpr (withMatrix) {
        StiffReaction stiff = kind.reactStiff(index, island_.motion.data(), exact);
        x = stiff;
        stiffness = stiff.stiffness;
      } else {
        x = kind.react(index, island_.motion.data());
      }
      V arm = (side & 1) ? x.armB : x.armA;
      if (!single) {
        RowEnds ends = kind.ends(index);
        arm += wide::load3(island_.masses[(side & 1) ? ends.b : ends.a].position) - centre;
      }
      V sign = wide::set((side & 1) ? 1.0f : -1.0f);
      V changed = x.force - readings_[row].force;
      force += sign * changed;
      torque += sign * (wide::cross3(arm, changed) + (x.torque - readings_[row].torque));
      if constexpr (withMatrix) sums->add(stiffness, arm);
    });
  }
  statistics_.solveSides += 4.0 * (cluster.sideEnd - cluster.sideBegin);
  return {wide::store3(force), wide::store3(torque)};
}

Wrench RowForces::readBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* sums) {
  trial_.resize(cluster.sideEnd - cluster.sideBegin);
  return sums ? sumBoundary<true>(level, cluster, exact, sums) : sumBoundary<false>(level, cluster, exact, nullptr);
}

}  // namespace brickfall
