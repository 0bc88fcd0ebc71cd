// What the rows of an island were last read to do, and what that leaves out of balance. A solve reads all of them once, then
// only those of what it moves: residuals follow by what has changed.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "solver/island.h"
#include "solver/newton_matrix.h"
#include "solver/rigid_cluster.h"

namespace brickfall {

class RowForces {
 public:
  RowForces(Island& island, SolveStatistics& statistics)
      : island_(island),
        statistics_(statistics),
        bodies_(std::uint32_t(island.bodies.size())),
        readings_(island.rows.size(), island.memory),
        trial_(island.memory),
        following_(island.memory) {}

  // All rows at the present motion: Island::residual. Bounds that follow the solve are renewed first.
  void readAll();
  // Bounds that have changed by more than a hundredth follow. `stiffer(ends)`: for each row that got stiffer.
  template <class Stiffer> void renewBounds(Stiffer&& stiffer) {
    for (std::uint32_t row : following_)
      island_.rows.at(row, [&](auto& kind, std::uint32_t index) {
        if (!kind.renewBounds(index, island_.motion.data(), kBoundSlack)) return;
        statistics_.lightVisits += kind.kPoints;
        take(row, kind.ends(index), readingOf(kind.template reactStiff<false>(index, island_.motion.data(), false)),
             stiffer);
      });
  }
  // Half the sum of the forces on each body: Island::loads.
  void findLoads();

  // By what the forces on a cluster's boundary have changed at the present motion, about its centre. With `sums`, their
  // stiffness there too. Kept until acceptBoundary. Exact: open points are not counted as closed when they are near.
  Wrench readBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* sums);
  // What readBoundary found last holds from now on. Returns false if the stiffness of a row of it follows its force.
  template <class Stiffer> bool acceptBoundary(const Level& level, const Cluster& cluster, Stiffer&& stiffer) {
    bool constant = true;
    for (std::uint32_t k = cluster.sideBegin; k < cluster.sideEnd; k++) {
      std::uint32_t row = level.sides[k] / 2;
      const Reading& now = trial_[k - cluster.sideBegin];
      constant = constant && !now.yields;
      island_.rows.at(row, [&](auto& kind, std::uint32_t index) { take(row, kind.ends(index), now, stiffer); });
    }
    return constant;
  }
  Island& island() const { return island_; }

 private:
  //! - | too small: cost | too large: new points slide under bounds that are not theirs
  static constexpr float kBoundSlack = 0.01f;  // of a bound: smaller changes are left

  struct Reading {
    Reaction at;
    std::uint32_t grip = 0;
    bool yields = false;
  };
  static Reading readingOf(const StiffReaction& x) { return {x, x.grip, x.yields}; }

  template <bool withMatrix>
  Wrench sumBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* sums);
  void add(RowEnds ends, const Reaction& at, wide::V force, wide::V torque);
  template <class Stiffer> void take(std::uint32_t row, RowEnds ends, const Reading& now, Stiffer&& stiffer) {
    Reading& old = readings_[row];
    add(ends, now.at, now.at.force - old.at.force, now.at.torque - old.at.torque);
    if (now.grip & ~old.grip) stiffer(ends);
    old = now;
  }

  Island& island_;
  SolveStatistics& statistics_;
  std::uint32_t bodies_;
  std::pmr::vector<Reading> readings_;         // by row
  std::pmr::vector<Reading> trial_;            // of the boundary read last
  std::pmr::vector<std::uint32_t> following_;  // rows with bounds that follow the solve
};

}  // namespace brickfall
