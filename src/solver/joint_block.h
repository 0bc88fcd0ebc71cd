// All bodies that joints tie in a large island, as one block of its sweeps. Joints are far too firm for bodies to be
// moved one by one: whole multipliers would fly apart, and a ball on a chain would stretch it. So these bodies take
// Newton steps together, while all others stay: a Cholesky factor in double, in an envelope as narrow as a chain.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/block_envelope.h"
#include "solver/row_forces.h"

namespace brickfall {

class JointBlock {
 public:
  // Of the island of these forces; empty where it has no joints.
  explicit JointBlock(RowForces& forces);

  bool any() const { return !bodies_.empty(); }
  bool has(std::uint32_t body) const { return any() && place_[body] != kNoIndex; }
  // One Newton step, with a search along it. Then, if wanted, the joints' multipliers follow the forces found.
  void apply(bool follow);

 private:
  void findBodies();
  void enterLoads();
  void findRows();
  void assemble();
  double slope() const;
  double moveTo(double part);
  void search(double start);
  void addInertias(float sign);

  Island& island_;
  RowForces& forces_;
  std::pmr::vector<std::uint32_t> place_;    // of a body in the matrix
  std::pmr::vector<std::uint32_t> bodies_;   // by place
  std::pmr::vector<std::uint32_t> rows_;     // on any of them
  std::pmr::vector<std::uint32_t> lasting_;  // those of ties that last
  std::pmr::vector<double> step_;
  std::pmr::vector<SolveMotion> from_;
  BlockEnvelope matrix_;
};

}  // namespace brickfall
