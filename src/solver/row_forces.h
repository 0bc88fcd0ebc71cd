// What the rows of an island were last read to do, and what that leaves out of balance. A solve reads all of them once, then
// only those of what it moves: residuals follow by what has changed.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "solver/boundary.h"
#include "solver/island.h"
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
  // The same with the bounds as they are.
  void readAgain();
  // Bounds that have changed by more than a hundredth follow. True if any did.
  bool renewBounds();
  // Those of what has opened are dropped where `wanted(ends)`. True if any was.
  template <class Wanted> bool dropBounds(Wanted wanted) {
    return changeBounds([&](auto& kind, std::uint32_t index) {
      return wanted(kind.ends(index)) && kind.dropBounds(index, island_.motion.data());
    });
  }
  // Half the sum of the forces on each body: Island::loads.
  void findLoads();

  // By what the forces on a cluster's boundary have changed at the present motion, about its centre. With `matrix`,
  // their stiffness there too. Kept until acceptBoundary. Exact: open points are not counted as closed when they are near.
  Wrench readBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* matrix);
  // What readBoundary found last holds from now on.
  void acceptBoundary(const Level& level, const Cluster& cluster);
  Island& island() const { return island_; }
  // Sides that readBoundary has read: how much of the island a solve has been at.
  std::size_t sidesRead() const { return sidesRead_; }

 private:
  //! - | too small: cost | too large: new points slide under bounds that are not theirs
  static constexpr float kBoundSlack = 0.01f;  // of a bound: smaller changes are left

  void take(std::uint32_t row, RowEnds ends, Arms arms, Reading now);
  // change(kind, index): true if the row's bounds are others now. True if any were changed.
  template <class Change> bool changeBounds(Change change) {
    bool any = false;
    for (std::uint32_t row : following_)
      island_.rows.at(row, [&](auto& kind, std::uint32_t index) {
        if (!change(kind, index)) return;
        any = true;
        statistics_.lightVisits += kind.kPoints;
        Reaction now = kind.react(index, island_.motion.data());
        take(row, kind.ends(index), {now.armA, now.armB}, {now.force, now.torque});
      });
    return any;
  }

  Island& island_;
  SolveStatistics& statistics_;
  std::uint32_t bodies_;
  std::size_t sidesRead_ = 0;
  std::pmr::vector<Reading> readings_;         // by row
  std::pmr::vector<Reading> trial_;            // of the boundary read last
  std::pmr::vector<std::uint32_t> following_;  // rows with bounds that follow the solve
};

}  // namespace brickfall
