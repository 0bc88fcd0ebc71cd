// All bodies that joints tie in a large island, as one block of its sweeps. Joints are far too firm for bodies to be
// moved one by one: whole multipliers would fly apart, and a ball on a chain would stretch it. So these bodies take
// Newton steps together, while all others stay: a Cholesky factor in double, in an envelope as narrow as a chain.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/block_envelope.h"
#include "solver/rounding.h"
#include "solver/row_forces.h"

namespace brickfall {

class JointBlock {
 public:
  // Of the island of these forces; empty where it has no joints.
  explicit JointBlock(RowForces& forces);

  bool any() const { return !bodies_.empty(); }
  bool has(std::uint32_t body) const { return any() && place_[body] != kNoIndex; }
  // As well as by a direct solve of the block.
  bool balanced(const BodySet& bodies) const;
  // Of a body, as the last step was found.
  Rounding rounding(std::uint32_t body) const { return rounding_.empty() ? Rounding() : rounding_[body]; }
  // One Newton step, with a search along it. True if it leads anywhere. The factor serves as long as steps by it get
  // shorter: in a wide net it is nearly all of the cost.
  bool apply();
  // The joints' multipliers follow the forces found. True if any changed.
  bool follow();

 private:
  void findBodies();
  void enterLoads();
  void findRows();
  void assemble();
  bool factor();
  void findStep();
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
  std::pmr::vector<Rounding> rounding_;  // by body of the island
  BlockEnvelope matrix_;
  double last_ = 0;  // slope along the last step; 0: the factor is none
};

}  // namespace brickfall
