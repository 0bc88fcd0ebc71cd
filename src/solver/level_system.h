// Newton's equations of all clusters of a level together, each as a rigid body:
//
//   (mass and inertia / dt^2 + stiffness of the rows between clusters, and to fixed bodies) x = residuals
//
// Solved by conjugate gradients. Gauss-Seidel sweeps settle clusters that touch against each other. A coarser level
// finds the motion that many clusters must make together, with so few clusters that its matrix is factored. (Two-grid
// preconditioner: Briggs, Henson and McCormick, A Multigrid Tutorial, 2000.) One to three iterations take a hit wall of
// any length to a fifth of the error. Products with the matrix come from the sweeps: what was settled is balanced.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/block_envelope.h"
#include "solver/block_rows.h"
#include "solver/island.h"

namespace brickfall {

class LevelSystem {
 public:
  // Of the clusters of a level: there is one above it.
  LevelSystem(const Island& island, const Hierarchy& hierarchy, std::size_t level);
  const Level& level() const { return fine_; }
  // Makes the matrix at the present motion; near open points count as closed. False if it is not positive definite.
  bool make();
  // x: about the solution, good enough for a step that is to be followed by others. It is nearer to the solution in
  // small islands, which are to be solved to the end.
  void solve(const Wrenches& right, Wrenches& x);

 private:
  struct Motions;
  static std::uint32_t clusterOf(const Level& level, std::uint32_t body) {
    return body < level.clusterOf.size() ? level.clusterOf[body] : kNoIndex;
  }
  wide::V armFrom(const Level& level, std::uint32_t cluster, std::uint32_t body, wide::V arm) const;
  bool chooseCoarse(const Level& level, double mostProducts);
  void addInertia();
  template <class Add> void addRow(const Level& level, RowEnds ends, const StiffReaction& x, Add add) const;
  void lock();
  void precondition(const Wrenches& right, Wrenches& x);

  const Island& island_;
  const Level& fine_;
  const Level* coarse_ = nullptr;
  std::pmr::memory_resource* const memory_ = island_.memory;
  BlockRows matrix_{memory_};                        // of fine_
  BlockEnvelope factor_{memory_};                    // of *coarse_
  std::pmr::vector<std::uint32_t> above_{memory_};   // by cluster of fine_: the cluster of *coarse_ that it is part of
  std::pmr::vector<std::uint32_t> places_{memory_};  // by cluster of *coarse_: its place in factor_
  struct Part {
    wide::V arm;          // m, from the centre of its cluster of *coarse_
    std::uint32_t place;  // of that
  };
  struct Way {
    wide::V way, turn;
  };
  std::pmr::vector<Part> parts_{memory_};      // by cluster of fine_; none without *coarse_
  std::pmr::vector<double> coarseX_{memory_};  // by place
  std::pmr::vector<Way> coarseWays_{memory_};  // the same, as floats
  // Of conjugate gradients, by cluster. `swept_`, `behind_`: of the preconditioner, before it sweeps back.
  Wrenches left_{memory_}, better_{memory_}, betterProduct_{memory_}, direction_{memory_}, product_{memory_},
      swept_{memory_}, behind_{memory_};
};

}  // namespace brickfall
