// All bodies that joints tie in a large island, as one block of its sweeps. Joints are far too firm for bodies to be
// moved one by one: whole multipliers would fly apart, and a ball on a chain would stretch it. So these bodies take
// Newton steps together, while all others stay: a Cholesky factor in double, in an envelope as narrow as a chain.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/body_newton.h"
#include "solver/row_forces.h"

namespace brickfall {

class JointBlock {
 public:
  // Of the island of these forces; empty where it has no joints.
  explicit JointBlock(RowForces& forces);

  bool any() const { return !newton_.bodies.empty(); }
  bool has(std::uint32_t body) const { return newton_.has(body); }
  // As well as by a direct solve of the block.
  bool balanced(const BodySet& bodies) const;
  // Of a body, as the last step was found.
  Rounding rounding(std::uint32_t body) const { return newton_.rounding.empty() ? Rounding() : newton_.rounding[body]; }
  // One Newton step, with a search along it. True if it leads anywhere. The factor serves as long as steps by it get
  // shorter: in a wide net it is nearly all of the cost.
  bool apply();
  // The joints' multipliers follow the forces found. True if any changed.
  bool follow();

 private:
  void findBodies();
  void enterLoads();
  void findRows();
  bool factor();
  double findStep();
  double moveTo(double part);
  void addInertias(float sign);

  Island& island_;
  RowForces& forces_;
  BodyNewton newton_{island_};
  std::pmr::vector<std::uint32_t> rows_{island_.memory};     // on any of its bodies
  std::pmr::vector<std::uint32_t> lasting_{island_.memory};  // those of ties that last
  bool kinks_ = false;                                       // some joint has a limit or is a rope
  double last_ = 0;                                          // slope along the last step; 0: the factor is none
};

}  // namespace brickfall
