// Numbers by which neighbours are near, and a matrix of neighbours' blocks, against a dense one.
#include "solver/block_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "math/random.h"

namespace brickfall::test {
namespace {

using TieList = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Adjacency adjacencyOf(std::uint32_t count, const TieList& ties) {
  Adjacency out(std::pmr::get_default_resource());
  out.fill(count, [&](auto visit) {
    for (auto [a, b] : ties) visit(a, b);
  });
  return out;
}
// A wall of so many columns and courses, each joint named twice, its bricks numbered by chance.
TieList wallTies(std::uint32_t columns, std::uint32_t courses, Random& random) {
  std::vector<std::uint32_t> number(columns * courses);
  for (std::uint32_t i = 0; i < number.size(); i++) number[i] = i;
  for (std::size_t i = number.size(); i-- > 1;) std::swap(number[i], number[random.below(std::uint32_t(i) + 1)]);
  TieList ties;
  for (std::uint32_t row = 0; row < courses; row++)
    for (std::uint32_t c = 0; c < columns; c++)
      for (auto [r2, c2] : {std::pair{row + 1, c}, std::pair{row, c + 1}})
        if (r2 < courses && c2 < columns)
          for (int twice = 0; twice < 2; twice++)
            ties.push_back({number[row * columns + c], number[r2 * columns + c2]});
  return ties;
}

TEST(Numbering, NamesEachNeighbourOnce) {
  Random random(3);
  TieList ties = wallTies(7, 5, random);
  Adjacency found = adjacencyOf(35, ties);
  ASSERT_EQ(found.count(), 35u);
  EXPECT_EQ(found.list.size(), ties.size()) << "both ends of every second one";
  for (auto [a, b] : ties)
    for (auto [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      auto begin = found.list.begin() + found.begin[from], end = found.list.begin() + found.begin[from + 1];
      EXPECT_EQ(std::count(begin, end, to), 1);
    }
}

TEST(Numbering, NeighboursAreNear) {
  Random random(5);
  for (std::uint32_t length : {20u, 200u}) {
    Adjacency wall = adjacencyOf(length * 4, wallTies(length, 4, random));
    std::pmr::vector<std::uint32_t> places = nearPlaces(wall), lowest = lowestPlaces(wall, places), sorted = places;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < sorted.size(); i++) ASSERT_EQ(sorted[i], i) << "a place twice or never";
    for (std::uint32_t i = 0; i < lowest.size(); i++)
      EXPECT_LE(i - lowest[i], 8u) << "of a wall of four courses, however long";
  }
}

TEST(Numbering, WhatDoesNotHangTogetherHasPlacesToo) {
  Adjacency parts = adjacencyOf(6, {{4, 1}, {2, 5}});
  std::pmr::vector<std::uint32_t> places = nearPlaces(parts);
  std::sort(places.begin(), places.end());
  for (std::uint32_t i = 0; i < 6; i++) EXPECT_EQ(places[i], i);
}

// Positive definite by its diagonal.
struct RandomRows {
  explicit RandomRows(std::uint32_t columns, std::uint32_t courses)
      : rows(columns * courses), matrix(std::pmr::get_default_resource()) {
    Random random(7);
    TieList ties = wallTies(columns, courses, random);
    matrix.shape(adjacencyOf(rows, ties));
    dense.assign(6 * rows, std::vector<double>(6 * rows));
    auto put = [&](BlockRows::Block& block, std::uint32_t row, std::uint32_t column, int i, int j, double v) {
      (i < 3 ? block.of[j].force[i] : block.of[j].torque[i - 3]) = float(v);
      for (auto [at, of] : {std::pair{6 * row + std::uint32_t(i), 6 * column + std::uint32_t(j)},
                            std::pair{6 * column + std::uint32_t(j), 6 * row + std::uint32_t(i)}})
        dense[at][of] = double(float(v));
    };
    for (std::uint32_t row = 0; row < rows; row++)
      for (int i = 0; i < 6; i++)
        for (int j = 0; j <= i; j++) {
          double v = i == j ? 30 : random.between(-1, 1);
          put(matrix.diagonal(row), row, row, i, j, v);
          put(matrix.diagonal(row), row, row, j, i, v);
        }
    for (auto [a, b] : ties)
      for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
          double v = random.between(-1, 1);
          if (a > b)
            put(matrix.at(a, b), a, b, i, j, v);
          else
            put(matrix.at(b, a), b, a, j, i, v);
        }
  }
  Wrenches random(int seed) const {
    Random draw{std::uint64_t(seed)};
    Wrenches out(rows);
    for (Wrench& w : out)
      for (int i = 0; i < 6; i++) (i < 3 ? w.force[i] : w.torque[i - 3]) = float(draw.between(-1, 1));
    return out;
  }
  std::uint32_t rows;
  BlockRows matrix;
  std::vector<std::vector<double>> dense;
};
double entry(const Wrenches& x, std::size_t i) {
  const Wrench& w = x[i / 6];
  return double(i % 6 < 3 ? w.force[int(i % 6)] : w.torque[int(i % 6) - 3]);
}

TEST(BlockRows, SweepsSettleEachRowAgainstThoseBefore) {
  RandomRows p(5, 4);
  ASSERT_TRUE(p.matrix.invert());
  Wrenches right = p.random(2), x(p.rows), left;
  p.matrix.sweepForwards(right, x, left);
  for (std::size_t i = 0; i < p.dense.size(); i++) {
    double behind = entry(right, i), all = behind;
    for (std::size_t j = 0; j < p.dense.size(); j++) {
      if (j / 6 <= i / 6) behind -= p.dense[i][j] * entry(x, j);
      all -= p.dense[i][j] * entry(x, j);
    }
    EXPECT_NEAR(behind, 0, 1e-4) << "from 0, those after it did nothing";
    EXPECT_NEAR(entry(left, i), all, 1e-4);
  }
  const Wrenches before = p.random(3);
  x = before;
  p.matrix.sweepBackwards(right, x);
  Wrenches product(p.rows);
  p.matrix.multiplySwept(right, before, x, product);
  double change = 0;
  for (std::size_t i = 0; i < p.dense.size(); i++) {
    double rest = entry(right, i), wanted = 0;  // when its turn came: rows before it were as they had been
    for (std::size_t j = 0; j < p.dense.size(); j++) {
      rest -= p.dense[i][j] * entry(j / 6 < i / 6 ? before : x, j);
      wanted += p.dense[i][j] * entry(x, j);
    }
    EXPECT_NEAR(rest, 0, 1e-4);
    EXPECT_NEAR(entry(product, i), wanted, 1e-4);
    change = std::max(change, std::fabs(entry(x, i) - entry(before, i)));
  }
  EXPECT_GT(change, 1e-3);
}

// Lanes of two kinds, of which a machine has one or both.
TEST(BlockSweeps, HaveTheSameBitsInAllLanes) {
  const SweepFunctions halves = sweepsInHalves();
  if (sweeps().forwards == halves.forwards) GTEST_SKIP() << "missing: a processor, or a compiler, with AVX2";
  RandomRows p(5, 4);
  std::vector<Block6> blocks, one(1), other(1);
  for (std::uint32_t row = 0; row < p.rows; row++) blocks.push_back(p.matrix.diagonal(row));
  for (const Block6& block : blocks) {
    ASSERT_TRUE(sweeps().invert(&block, 1, one.data()));
    ASSERT_TRUE(halves.invert(&block, 1, other.data()));
    EXPECT_EQ(std::memcmp(one.data(), other.data(), sizeof(Block6)), 0);
  }
  const std::uint32_t begin[] = {0, 0, 1}, list[] = {0};
  const BlockView view{2, begin, list, &blocks[2], blocks.data()};
  const Wrenches right = p.random(1);
  auto run = [&](const SweepFunctions& f) {
    Wrenches x(2), left(2), out(2), rest(right.begin(), right.begin() + 2);
    f.forwards(view, right.data(), x.data(), left.data());
    const Wrenches from = x;
    f.backwards(view, rest.data(), x.data());
    f.multiply(view, right.data(), from.data(), x.data(), out.data());
    Wrenches all;
    for (const Wrenches* found : {&x, &left, &rest, &out}) all.insert(all.end(), found->begin(), found->end());
    return all;
  };
  const Wrenches a = run(sweeps()), b = run(halves);
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Wrench)), 0);
}

TEST(BlockRows, SaysWhatIsNotPositiveDefinite) {
  RandomRows p(2, 2);
  p.matrix.diagonal(3).of[4].torque.y = -1;
  EXPECT_FALSE(p.matrix.invert());
  p.matrix.clear();
  EXPECT_FALSE(p.matrix.invert()) << "all is 0";
}

TEST(BlockRows, SumsOfProductsAndShares) {
  Wrenches x{{{1, 2, 3}, {4, 5, 6}}, {{-1, 0, 2}, {0, 0, 1}}}, y{{{2, 0, 1}, {1, 1, 0}}, {{3, 5, 1}, {0, 2, -4}}};
  EXPECT_EQ(dotOf(x, y), 2 + 0 + 3 + 4 + 5 + 0 - 3 + 0 + 2 + 0 + 0 - 4);
  addTimes(x, y, 2);
  EXPECT_EQ(x[0].force.x, 5);
  EXPECT_EQ(x[0].torque.z, 6);
  EXPECT_EQ(x[1].force.y, 10);
  EXPECT_EQ(x[1].torque.z, -7);
}

}  // namespace
}  // namespace brickfall::test
