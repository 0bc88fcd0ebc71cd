// All clusters of a level at once: one Newton step of the island as if each of them were rigid.
//
// Single bodies find the motion of a wall as a whole (it sways, leans, is pushed along) only slowly, each from its
// neighbours. The step finds it for all of them; bending and parting within the clusters is left to the bodies. Where
// firm ties hold, the level is that of the bodies: what strains the clusters then spreads as far as they reach. The
// matrix is kept as that of a single body is.
#pragma once
#include <memory_resource>
#include <optional>
#include <vector>

#include "solver/level_system.h"
#include "solver/row_forces.h"

namespace brickfall {

class LevelStep {
 public:
  // Of the clusters of a level. Nothing is made before the first step.
  LevelStep(RowForces& forces, const Hierarchy& hierarchy, std::size_t level)
      : forces_(forces), island_(forces.island()), hierarchy_(hierarchy), number_(level) {}
  // Moves the island's bodies, and reads its forces there.
  void apply();

 private:
  friend struct LevelWay;
  void findResiduals();
  void keepLocks(Wrenches& wrenches) const;

  RowForces& forces_;
  Island& island_;
  const Hierarchy& hierarchy_;
  const std::size_t number_;  // of the level
  std::optional<LevelSystem> system_;
  bool valid_ = false;                                         // the matrix
  Wrenches residuals_{island_.memory}, step_{island_.memory};  // by cluster
  std::pmr::vector<SolveMotion> from_{island_.memory};         // by body
};

}  // namespace brickfall
