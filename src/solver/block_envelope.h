// A symmetric matrix of blocks of 6 x 6, and its Cholesky factor in place. A row of blocks is stored from its first
// block that can be other than 0 to the diagonal. In doubles; the same bits on any machine.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace brickfall {

class BlockEnvelope {
 public:
  explicit BlockEnvelope(std::pmr::memory_resource* memory) : lowest_(memory), begin_(memory), blocks_(memory) {}

  // lowest: the first column of each row of blocks. Sets all entries to 0.
  void shape(const std::pmr::vector<std::uint32_t>& lowest);
  void clear();
  // Adds a block on or under the diagonal, by columns. A block on the diagonal is given whole.
  void add(std::size_t row, std::size_t column, const double (&b)[6][6]);
  // Times so much on the diagonal, where `rows` has a bit: what these six unknowns find is 0 to all others.
  void stiffen(std::size_t row, unsigned rows, double times);
  // False if not positive definite.
  bool factor();
  // After factor: x, 6 numbers a row of blocks, is the right side and becomes the solution.
  void solve(double* x) const;

 private:
  // A block by columns, so that no sum runs along a vector. In a factored block on the diagonal, the entries on the
  // diagonal are their inverses.
  struct Block {
    double column[6][6];
  };
  static void takeProducts(Block& from, const Block* left, const Block* right, std::size_t count);
  static void takeSquare(Block& from, const Block& left);
  static void divideBy(Block& b, const Block& diagonal);
  static bool factorDiagonal(Block& b);

  const Block& at(std::size_t row, std::size_t column) const { return blocks_[begin_[row] + column - lowest_[row]]; }
  Block& at(std::size_t row, std::size_t column) { return blocks_[begin_[row] + column - lowest_[row]]; }

  std::pmr::vector<std::uint32_t> lowest_;
  std::pmr::vector<std::size_t> begin_;  // by row, in blocks_
  std::pmr::vector<Block> blocks_;
};

}  // namespace brickfall
