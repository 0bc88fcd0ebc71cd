// The action of an island's rows as last read, and the residuals that follow. A solve reads all rows once, then only
// the rows of bodies that it moves: residuals follow by the change.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "solver/imbalance.h"
#include "solver/island.h"

namespace brickfall {

class RowForces {
 public:
  RowForces(Island& island, SolveStatistics& statistics)
      : island_(island), statistics_(statistics), readings_(island.rows.size(), island.memory) {}

  // Reads all rows at the present motion: Island::residual. Friction limits that follow the solve are renewed first.
  void readAll();
  // The same with the friction limits as they are.
  void readAgain();
  // Renews friction limits that follow the solve, where they changed by more than a hundredth. True if any did.
  bool renewBounds();
  // Raises friction limits of points that bear far more than these are made for. True if any changed.
  bool holdJams();
  // These rows once more, at the present motion.
  void readRows(const std::pmr::vector<std::uint32_t>& rows);
  // What a row keeps frozen follows the force found.
  bool settle(std::uint32_t row);
  // Half the sum of the forces on each body: Island::loads.
  void findLoads();
  // The same of one body, whose sides these are.
  void findLoad(const Level& level, const Cluster& single, std::uint32_t body);

  // By how much the forces on a cluster's boundary have changed at the present motion, about its centre. With `matrix`,
  // their stiffness there too. Kept until acceptBoundary. Exact: near open points do not count as closed.
  Wrench readBoundary(const Level& level, const Cluster& cluster, bool exact, MatrixSums* matrix);
  // The last reading of readBoundary is valid from now on.
  void acceptBoundary(const Level& level, const Cluster& cluster);
  Island& island() const { return island_; }
  // Sides that readBoundary has read: how much of the island a solve has worked on.
  std::size_t sidesRead() const { return sidesRead_; }

 private:
  void take(std::uint32_t row, RowEnds ends, Arms arms, Reading now);
  template <class Kind> void readRow(std::uint32_t row, const Kind& kind, std::size_t index);

  Island& island_;
  SolveStatistics& statistics_;
  std::uint32_t bodies_ = std::uint32_t(island_.bodies.size());
  std::size_t sidesRead_ = 0;
  std::pmr::vector<Reading> readings_;                         // by row
  std::pmr::vector<Reading> trial_{island_.memory};            // of the boundary read last
  std::pmr::vector<std::uint32_t> following_{island_.memory};  // rows with friction limits that follow the solve
};

}  // namespace brickfall
