#include "solver/level_system.h"

#include "solver/light_pass.h"
#include "solver/slope_search.h"

namespace brickfall {

namespace {

//! products of blocks for each row of the island | too small: long walls take more iterations
//! | too large: cost of factors
constexpr double kMostProducts = 2;  // in a factorisation of the coarse level
//! - | too small: steps that do not fit the whole | too large: cost of motion that the next step finds again
constexpr int kMostIterations = 4;

using wide::cross3;
using wide::spread;
using wide::V;

// For the envelope: by columns.
void addTo(BlockEnvelope& matrix, std::uint32_t row, std::uint32_t column, const BlockRows::Block& block) {
  double b[6][6];
  for (int j = 0; j < 6; j++)
    for (int k = 0; k < 3; k++) {
      b[j][k] = double(block.of[j].force[k]);
      b[j][k + 3] = double(block.of[j].torque[k]);
    }
  matrix.add(row, column, b);
}

BlockRows::Block inertiaOf(const Cluster& c) {
  BlockRows::Block out;
  for (int k = 0; k < 3; k++) out.of[k].force[k] = c.mass;
  const float* i = c.inertia;
  out.of[3].torque = {i[0], i[1], i[3]};
  out.of[4].torque = {i[1], i[2], i[4]};
  out.of[5].torque = {i[3], i[4], i[5]};
  return out;
}

}  // namespace

// A row's answer, at its centre, to the six motions of a cluster whose centre is `arm` away.
struct LevelSystem::Motions {
  V force[6], torque[6];

  Motions(const Stiffness& s, V arm) {
    V x = spread<0>(arm), y = spread<1>(arm), z = spread<2>(arm);
    for (int j = 0; j < 3; j++) {
      force[j] = s.A[j];
      torque[j] = s.B[j];
      force[3 + j] = V{s.B[0][j], s.B[1][j], s.B[2][j], 0};
      torque[3 + j] = s.C[j];
    }
    force[3] += y * s.A[2] - z * s.A[1];
    force[4] += z * s.A[0] - x * s.A[2];
    force[5] += x * s.A[1] - y * s.A[0];
    torque[3] += y * s.B[2] - z * s.B[1];
    torque[4] += z * s.B[0] - x * s.B[2];
    torque[5] += x * s.B[1] - y * s.B[0];
  }
  // Adds the action on the moving cluster (sign 1), or on the row's other end (-1), about its centre.
  void addTo(BlockRows::Block& block, V arm, float sign) const {
    for (int j = 0; j < 6; j++) {
      Wrench& to = block.of[j];
      wide::store(wide::load(&to.force.x) + force[j] * sign, &to.force.x);
      wide::store(wide::load(&to.torque.x) + (cross3(arm, force[j]) + torque[j]) * sign, &to.torque.x);
    }
  }
};

LevelSystem::LevelSystem(const Island& island, const Hierarchy& hierarchy, std::size_t level)
    : island_(island), fine_(hierarchy.levels[level]) {
  Adjacency neighbours(island.memory);
  neighbours.fill(std::uint32_t(fine_.clusters.size()), [&](auto visit) {
    island.rows.each([&](const auto& kind, std::size_t k) {
      RowEnds ends = kind.ends(k);
      std::uint32_t a = clusterOf(fine_, ends.a), b = clusterOf(fine_, ends.b);
      if (a != b && a != kNoIndex && b != kNoIndex) visit(a, b);
    });
  });
  matrix_.shape(neighbours);
  // The finest level that is cheap enough; the last has one cluster.
  for (std::size_t l = level + 1; l < hierarchy.levels.size(); l++)
    if (chooseCoarse(hierarchy.levels[l], kMostProducts * double(island.rows.size()))) break;
  if (!coarse_) return;
  for (std::uint32_t c = 0; c < fine_.clusters.size(); c++)
    parts_.push_back(
        {wide::load3(fine_.clusters[c].centre) - wide::load3(coarse_->clusters[above_[c]].centre), places_[above_[c]]});
}

bool LevelSystem::chooseCoarse(const Level& level, double mostProducts) {
  above_.clear();
  for (const Cluster& c : fine_.clusters) above_.push_back(level.clusterOf[fine_.bodies[c.bodyBegin]]);
  const Adjacency& fine = matrix_.earlier();
  Adjacency neighbours(island_.memory);
  neighbours.fill(std::uint32_t(level.clusters.size()), [&](auto visit) {
    for (std::uint32_t c = 0; c < fine.count(); c++)
      for (std::uint32_t k = fine.begin[c]; k < fine.begin[c + 1]; k++)
        if (above_[c] != above_[fine.list[k]]) visit(above_[c], above_[fine.list[k]]);
  });
  places_ = nearPlaces(neighbours);
  std::pmr::vector<std::uint32_t> lowest = lowestPlaces(neighbours, places_);
  double products = 0;
  for (std::size_t row = 0; row < lowest.size(); row++) {
    double width = double(row - lowest[row] + 1);
    products += width * width / 2;
  }
  if (products > mostProducts) return false;
  factor_.shape(lowest);
  coarse_ = &level;
  return true;
}

void LevelSystem::addInertia() {
  for (std::uint32_t c = 0; c < fine_.clusters.size(); c++) matrix_.diagonal(c) = inertiaOf(fine_.clusters[c]);
  if (!coarse_) return;
  for (std::size_t c = 0; c < coarse_->clusters.size(); c++)
    addTo(factor_, places_[c], places_[c], inertiaOf(coarse_->clusters[c]));
}

// After all else is in the matrices.
void LevelSystem::lock() {
  if (!anyLocks(island_)) return;
  for (std::uint32_t c = 0; c < fine_.clusters.size(); c++) {
    const std::uint8_t locks = locksOf(island_, fine_, fine_.clusters[c]);
    for (int k = 0; k < 6; k++) {
      if (!(locks >> k & 1)) continue;
      Wrench& to = matrix_.diagonal(c).of[k];
      float& own = k < 3 ? to.force[k] : to.torque[k - 3];
      own *= kLockedStiffness;
    }
  }
  if (!coarse_) return;
  for (std::size_t c = 0; c < coarse_->clusters.size(); c++) {
    const Cluster& cluster = coarse_->clusters[c];
    factor_.stiffen(places_[c], locksOf(island_, *coarse_, cluster), kLockedStiffness);
  }
}

// From the cluster's centre to the row's centre.
V LevelSystem::armFrom(const Level& level, std::uint32_t cluster, std::uint32_t body, V arm) const {
  return arm + (wide::load3(island_.masses[body].position) - wide::load3(level.clusters[cluster].centre));
}

// add(cluster on which the row acts, cluster that moves, Motions, arm, sign)
template <class Add> void LevelSystem::addRow(const Level& level, RowEnds ends, const StiffReaction& x, Add add) const {
  const std::uint32_t bodies[2] = {ends.a, ends.b};
  const V arms[2] = {x.armA, x.armB};
  for (int i = 0; i < 2; i++) {
    std::uint32_t own = clusterOf(level, bodies[i]), other = clusterOf(level, bodies[1 - i]);
    if (own == kNoIndex) continue;
    V arm = armFrom(level, own, bodies[i], arms[i]);
    Motions motions(x.stiffness, arm);
    add(own, own, motions, arm, 1);
    if (other != kNoIndex) add(other, own, motions, armFrom(level, other, bodies[1 - i], arms[1 - i]), -1);
  }
}

bool LevelSystem::make() {
  matrix_.clear();
  factor_.clear();
  addInertia();
  auto add = [&](RowEnds ends, const StiffReaction& now) {
    addRow(fine_, ends, now, [&](std::uint32_t to, std::uint32_t moved, const Motions& motions, V arm, float sign) {
      if (to >= moved) motions.addTo(to == moved ? matrix_.diagonal(to) : matrix_.at(to, moved), arm, sign);
    });
    if (!coarse_ || clusterOf(*coarse_, ends.a) == clusterOf(*coarse_, ends.b)) return;
    addRow(*coarse_, ends, now, [&](std::uint32_t to, std::uint32_t moved, const Motions& motions, V arm, float sign) {
      if (places_[to] < places_[moved]) return;
      BlockRows::Block block;
      motions.addTo(block, arm, sign);
      addTo(factor_, places_[to], places_[moved], block);
    });
  };
  island_.rows.eachKind([&](const auto& kind) {
    std::uint32_t rows[kRowsAtATime] = {};
    StiffReaction now[kRowsAtATime];
    std::size_t count = 0;
    auto addThese = [&] {
      kind.readStiff(rows, count, island_.motion.data(), Resist::nearly, now);
      for (std::size_t i = 0; i < count; i++) add(kind.ends(rows[i]), now[i]);
      count = 0;
    };
    for (std::uint32_t k = 0; k < kind.size(); k++) {
      const RowEnds ends = kind.ends(k);
      if (clusterOf(fine_, ends.a) == clusterOf(fine_, ends.b)) continue;
      rows[count++] = k;
      if (count == kRowsAtATime) addThese();
    }
    addThese();
  });
  lock();
  return matrix_.invert() && factor_.factor();
}

// Symmetric: forwards, together, backwards.
void LevelSystem::precondition(const Wrenches& right, Wrenches& x) {
  matrix_.sweepForwards(right, x, behind_);
  if (coarse_) {
    coarseX_.assign(6 * places_.size(), 0);
    for (std::uint32_t c = 0; c < parts_.size(); c++) {
      const Wrench& left = behind_[c];
      V force = wide::load(&left.force.x), torque = wide::load(&left.torque.x) + cross3(parts_[c].arm, force);
      double* six = coarseX_.data() + 6 * parts_[c].place;
      for (int k = 0; k < 3; k++) {
        six[k] += double(force[k]);
        six[k + 3] += double(torque[k]);
      }
    }
    factor_.solve(coarseX_.data());
    coarseWays_.clear();
    for (const double* six = coarseX_.data(); six != coarseX_.data() + coarseX_.size(); six += 6)
      coarseWays_.push_back(
          Way{V{float(six[0]), float(six[1]), float(six[2]), 0}, V{float(six[3]), float(six[4]), float(six[5]), 0}});
    for (std::uint32_t c = 0; c < parts_.size(); c++) {
      const auto& [way, turn] = coarseWays_[parts_[c].place];
      wide::store(wide::load(&x[c].force.x) + (way + cross3(turn, parts_[c].arm)), &x[c].force.x);
      wide::store(wide::load(&x[c].torque.x) + turn, &x[c].torque.x);
    }
  }
  swept_.assign(x.begin(), x.end());
  matrix_.sweepBackwards(right, x);
}

void LevelSystem::solve(const Wrenches& right, Wrenches& x) {
  x.assign(right.size(), {});
  left_.assign(right.begin(), right.end());
  better_.resize(right.size());
  betterProduct_.resize(right.size());
  direction_.assign(right.size(), {});
  product_.assign(right.size(), {});
  double before = 0, enough = 0;
  for (int k = 0; k < kMostIterations; k++) {
    precondition(left_, better_);
    const double now = dotOf(left_, better_);
    if (!(now > enough)) return;
    if (k == 0) enough = double(kNearMinimum * kNearMinimum) * now;
    const float again = k == 0 ? 0 : float(now / before);
    before = now;
    matrix_.multiplySwept(left_, swept_, better_, betterProduct_);
    addTimes(better_, direction_, again);
    direction_.swap(better_);
    addTimes(betterProduct_, product_, again);
    product_.swap(betterProduct_);
    const double curvature = dotOf(direction_, product_);
    if (!(curvature > 0)) return;
    const float part = float(now / curvature);
    addTimes(x, direction_, part);
    addTimes(left_, product_, -part);
  }
}

}  // namespace brickfall
