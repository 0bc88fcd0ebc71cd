// A symmetric positive definite matrix of blocks of 6 x 6: how rigid bodies or clusters act on each other. A row has
// one block on the diagonal and one for each neighbour. In floats, four lanes. Six numbers are a Wrench: force and
// torque on the right side, displacement and turn among the unknowns.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/numbering.h"
#include "solver/symmetric6.h"

namespace brickfall {

using Wrenches = std::pmr::vector<Wrench>;  // by row

// x . y, in doubles.
double dotOf(const Wrenches& x, const Wrenches& y);
// x += share y
void addTimes(Wrenches& x, const Wrenches& y, float share);

class BlockRows {
 public:
  // Force and torque that answer each of six unit motions.
  struct Block {
    Wrench of[6];
  };

  explicit BlockRows(std::pmr::memory_resource* memory)
      : neighbours_(memory), diagonal_(memory), blocks_(memory), factors_(memory) {}
  // Makes as many rows as there are neighbours, and sets all blocks to 0.
  void shape(Adjacency neighbours);
  const Adjacency& neighbours() const { return neighbours_; }
  void clear();
  Block& diagonal(std::uint32_t row) { return diagonal_[row]; }
  // The block of a row and its neighbour. Both halves of the matrix are written.
  Block& at(std::uint32_t row, std::uint32_t column) { return blocks_[neighbours_.find(row, column)]; }

  void multiply(const Wrenches& x, Wrenches& out) const;
  // Factors the diagonal, for the sweeps. False if it is not positive definite.
  bool factor();
  // Gauss-Seidel from x = 0, first row to last; and the same backwards from the x given.
  void sweepForwards(const Wrenches& right, Wrenches& x) const;
  void sweepBackwards(const Wrenches& right, Wrenches& x) const;
  // Right side less matrix x, for one row, where x comes from sweepForwards: the change that later rows have made.
  Wrench leftForwards(std::uint32_t row, const Wrenches& x) const;

 private:
  // Solves one row for its own unknowns, with those of neighbours below a row as they are, the others 0.
  void settle(std::uint32_t row, const Wrenches& right, Wrenches& x, std::uint32_t below) const;

  Adjacency neighbours_;
  std::pmr::vector<Block> diagonal_;  // by row
  std::pmr::vector<Block> blocks_;    // as neighbours_.list
  std::pmr::vector<Symmetric6> factors_;
};

}  // namespace brickfall
