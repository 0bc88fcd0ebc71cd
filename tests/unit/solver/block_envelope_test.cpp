// The factor of a matrix of blocks, against its products.
#include "solver/block_envelope.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"

namespace brickfall::test {
namespace {

using Dense = std::vector<std::vector<double>>;

// Rows of blocks that reach back as `lowest` says; positive definite by its diagonal. `shift` is taken off that.
struct Problem {
  Problem(std::initializer_list<std::uint32_t> lowest, double shift = 0)
      : lowest_(lowest),
        matrix(std::pmr::get_default_resource()),
        dense(6 * lowest.size(), std::vector<double>(6 * lowest.size())) {
    matrix.shape(lowest_);
    Random random(11);
    for (std::size_t row = 0; row < lowest_.size(); row++)
      for (std::size_t column = lowest_[row]; column <= row; column++) {
        double b[6][6];  // by columns
        for (int i = 0; i < 6; i++)
          for (int j = 0; j < 6; j++) {
            b[j][i] = row == column && j < i ? b[i][j] : random.between(-1, 1);
            if (row == column && i == j) b[j][i] = 20 * double(lowest_.size()) - shift;
            dense[6 * row + std::size_t(i)][6 * column + std::size_t(j)] = b[j][i];
          }
        for (int i = 0; i < 6; i++)
          for (int j = 0; j < 6; j++) dense[6 * column + std::size_t(j)][6 * row + std::size_t(i)] = b[j][i];
        matrix.add(row, column, b);
      }
  }
  std::pmr::vector<std::uint32_t> lowest_;
  BlockEnvelope matrix;
  Dense dense;
};

// A chain, an arrow, a full matrix, parts that know nothing of each other.
TEST(BlockEnvelope, SolvesWhatWasPutIn) {
  for (std::initializer_list<std::uint32_t> lowest : {std::initializer_list<std::uint32_t>{0},
                                                      {0, 0, 1, 2, 3, 4},
                                                      {0, 1, 2, 3, 0},
                                                      {0, 0, 0, 0},
                                                      {0, 0, 2, 2, 1, 3}}) {
    Problem p(lowest);
    Random random(5);
    std::vector<double> wanted(p.dense.size()), x(p.dense.size(), 0);
    for (double& w : wanted) w = random.between(-1, 1);
    for (std::size_t i = 0; i < x.size(); i++)
      for (std::size_t j = 0; j < x.size(); j++) x[i] += p.dense[i][j] * wanted[j];
    ASSERT_TRUE(p.matrix.factor());
    p.matrix.solve(x.data());
    for (std::size_t i = 0; i < x.size(); i++) EXPECT_NEAR(x[i], wanted[i], 1e-13) << lowest.size() << " rows, " << i;
  }
}

TEST(BlockEnvelope, WhatIsNotPositiveDefiniteHasNoFactor) {
  Problem p({0, 0, 1}, 61);
  EXPECT_FALSE(p.matrix.factor());
}

TEST(BlockEnvelope, IsEmptyAfterClearAndAddsUp) {
  Problem p({0, 0});
  p.matrix.clear();
  EXPECT_FALSE(p.matrix.factor()) << "zeros";
  p.matrix.clear();
  double one[6][6] = {};
  for (int i = 0; i < 6; i++) one[i][i] = 2;
  for (std::size_t k = 0; k < 2; k++) p.matrix.add(k, k, one), p.matrix.add(k, k, one);
  ASSERT_TRUE(p.matrix.factor());
  double x[12] = {4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48};
  p.matrix.solve(x);
  for (int i = 0; i < 12; i++) EXPECT_EQ(x[i], i + 1);
}

}  // namespace
}  // namespace brickfall::test
