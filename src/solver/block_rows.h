// A symmetric positive definite matrix of blocks of 6 x 6: how rigid bodies or clusters act on each other. A row has
// one block on the diagonal and one for each neighbour. In floats, four lanes. Six numbers are a Wrench: force and
// torque on the right side, displacement and turn among the unknowns.
//
// Only blocks left of the diagonal are kept. A sweep reads each of them once: what the earlier row does to the later
// one and what that does to the earlier one are taken while the block is at hand.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/block_sweeps.h"
#include "solver/numbering.h"

namespace brickfall {

using Wrenches = std::pmr::vector<Wrench>;  // by row

// x . y, in doubles.
double dotOf(const Wrenches& x, const Wrenches& y);
// x += share y
void addTimes(Wrenches& x, const Wrenches& y, float share);

class BlockRows {
 public:
  using Block = Block6;

  explicit BlockRows(std::pmr::memory_resource* memory)
      : earlier_(memory), diagonal_(memory), inverses_(memory), blocks_(memory), rest_(memory) {}
  // Makes as many rows as there are neighbours, and sets all blocks to 0.
  void shape(const Adjacency& neighbours);
  // Of each row those before it.
  const Adjacency& earlier() const { return earlier_; }
  void clear();
  Block& diagonal(std::uint32_t row) { return diagonal_[row]; }
  // The block of a row and an earlier neighbour: force on the row by motions of that.
  Block& at(std::uint32_t row, std::uint32_t before) { return blocks_[earlier_.find(row, before)]; }

  // Inverts the diagonal, for the sweeps. False if it is not positive definite.
  bool invert();
  // Gauss-Seidel from x = 0, first row to last. `left`: right side less matrix x, by what later rows changed.
  void sweepForwards(const Wrenches& right, Wrenches& x, Wrenches& left) const;
  // The same from the x given, last row to first.
  void sweepBackwards(const Wrenches& right, Wrenches& x);
  // Matrix x, where sweepBackwards made x of `from`: each row was settled against earlier ones of `from`.
  void multiplySwept(const Wrenches& right, const Wrenches& from, const Wrenches& x, Wrenches& out) const;

 private:
  BlockView view() const;

  Adjacency earlier_;
  std::pmr::vector<Block> diagonal_, inverses_;  // by row
  std::pmr::vector<Block> blocks_;               // as earlier_.list
  Wrenches rest_;                                // of a right side: less what later rows do
};

}  // namespace brickfall
