// The action of an island's rows as last read, and the residuals that follow. A solve reads all rows once, then only
// the rows of bodies that it moves: residuals follow by the change.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "solver/boundary.h"
#include "solver/island.h"
#include "solver/rigid_cluster.h"

namespace brickfall {

//! - | too small: stacks that land, or are made leaning, shear; points that open for a moment lose their friction
//! | too large: cost
constexpr int kBoundRounds =
    3;  // so often the direct solve begins anew; so many last cycles drop opened points' limits

class RowForces {
 public:
  RowForces(Island& island, SolveStatistics& statistics)
      : island_(island),
        statistics_(statistics),
        bodies_(std::uint32_t(island.bodies.size())),
        readings_(island.rows.size(), island.memory),
        trial_(island.memory),
        following_(island.memory) {}

  // Reads all rows at the present motion: Island::residual. Friction limits that follow the solve are renewed first.
  void readAll();
  // The same with the friction limits as they are.
  void readAgain();
  // Renews friction limits that follow the solve, where they changed by more than a hundredth. True if any did.
  bool renewBounds();
  // Drops the friction limits of opened points where `wanted(ends)`. True if any was dropped.
  template <class Wanted> bool dropBounds(Wanted wanted) {
    return changeBounds([&](auto& kind, std::uint32_t index) {
      return wanted(kind.ends(index)) && kind.dropBounds(index, island_.motion.data());
    });
  }
  // These rows once more, at the present motion.
  void readRows(const std::pmr::vector<std::uint32_t>& rows);
  // What a row keeps frozen follows the force found.
  void settle(std::uint32_t row);
  // Half the sum of the forces on each body: Island::loads.
  void findLoads();

  // By how much the forces on a cluster's boundary have changed at the present motion, about its centre. With `matrix`,
  // their stiffness there too. Kept until acceptBoundary. Exact: near open points do not count as closed.
  Wrench readBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* matrix);
  // The last reading of readBoundary is valid from now on.
  void acceptBoundary(const Level& level, const Cluster& cluster);
  Island& island() const { return island_; }
  // Sides that readBoundary has read: how much of the island a solve has worked on.
  std::size_t sidesRead() const { return sidesRead_; }

 private:
  //! - | too small: cost | too large: new points slide under friction limits that are not theirs
  static constexpr float kBoundSlack = 0.01f;  // of a friction limit: a smaller change is left

  void take(std::uint32_t row, RowEnds ends, Arms arms, Reading now);
  // change(kind, index): true if the row's friction limits have changed. Returns true if any were changed.
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
  std::pmr::vector<std::uint32_t> following_;  // rows with friction limits that follow the solve
};

}  // namespace brickfall
