#include "solver/block_rows.h"

#include <algorithm>
#include <utility>

namespace brickfall {

namespace {

using wide::spread;
using wide::V;

struct SixSum {
  V force = {}, torque = {};

  void take(const BlockRows::Block& block, const Wrench& x) {  // -= block x
    V d = wide::load(&x.force.x), th = wide::load(&x.torque.x);
    const V parts[6] = {spread<0>(d), spread<1>(d), spread<2>(d), spread<0>(th), spread<1>(th), spread<2>(th)};
    for (int j = 0; j < 6; j++) {
      force -= wide::load(&block.of[j].force.x) * parts[j];
      torque -= wide::load(&block.of[j].torque.x) * parts[j];
    }
  }
};

}  // namespace

double dotOf(const Wrenches& x, const Wrenches& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); i++) {
    V part =
        wide::load(&x[i].force.x) * wide::load(&y[i].force.x) + wide::load(&x[i].torque.x) * wide::load(&y[i].torque.x);
    sum += double((part[0] + part[2]) + part[1]);
  }
  return sum;
}

void addTimes(Wrenches& x, const Wrenches& y, float share) {
  for (std::size_t i = 0; i < x.size(); i++) {
    wide::store(wide::load(&x[i].force.x) + wide::load(&y[i].force.x) * share, &x[i].force.x);
    wide::store(wide::load(&x[i].torque.x) + wide::load(&y[i].torque.x) * share, &x[i].torque.x);
  }
}

void BlockRows::shape(Adjacency neighbours) {
  neighbours_ = std::move(neighbours);
  diagonal_.resize(neighbours_.count());
  factors_.resize(neighbours_.count());
  blocks_.resize(neighbours_.list.size());
  clear();
}

void BlockRows::clear() {
  std::fill(diagonal_.begin(), diagonal_.end(), Block{});
  std::fill(blocks_.begin(), blocks_.end(), Block{});
}

void BlockRows::multiply(const Wrenches& x, Wrenches& out) const {
  for (std::uint32_t row = 0; row < diagonal_.size(); row++) {
    SixSum sum;
    sum.take(diagonal_[row], x[row]);
    for (std::uint32_t k = neighbours_.begin[row]; k < neighbours_.begin[row + 1]; k++)
      sum.take(blocks_[k], x[neighbours_.list[k]]);
    wide::store(-sum.force, &out[row].force.x);
    wide::store(-sum.torque, &out[row].torque.x);
  }
}

bool BlockRows::factor() {
  for (std::size_t row = 0; row < diagonal_.size(); row++) {
    for (int column = 0; column < 6; column++)
      for (int i = column; i < 6; i++) {
        const Wrench& of = diagonal_[row].of[column];
        factors_[row].at(i, column) = i < 3 ? of.force[i] : of.torque[i - 3];
      }
    if (!factors_[row].factor()) return false;
  }
  return true;
}

void BlockRows::sweepForwards(const Wrenches& right, Wrenches& x) const {
  for (std::uint32_t row = 0; row < diagonal_.size(); row++) settle(row, right, x, row);
}

void BlockRows::sweepBackwards(const Wrenches& right, Wrenches& x) const {
  const std::uint32_t rows = std::uint32_t(diagonal_.size());
  for (std::uint32_t row = rows; row-- > 0;) settle(row, right, x, rows);
}

void BlockRows::settle(std::uint32_t row, const Wrenches& right, Wrenches& x, std::uint32_t below) const {
  SixSum sum{wide::load(&right[row].force.x), wide::load(&right[row].torque.x)};
  for (std::uint32_t k = neighbours_.begin[row]; k < neighbours_.begin[row + 1]; k++)
    if (std::uint32_t other = neighbours_.list[k]; other < below) sum.take(blocks_[k], x[other]);
  x[row] = factors_[row].solve({wide::store3(sum.force), wide::store3(sum.torque)});
}

Wrench BlockRows::leftForwards(std::uint32_t row, const Wrenches& x) const {
  SixSum sum;
  for (std::uint32_t k = neighbours_.begin[row]; k < neighbours_.begin[row + 1]; k++)
    if (std::uint32_t other = neighbours_.list[k]; other > row) sum.take(blocks_[k], x[other]);
  return {wide::store3(sum.force), wide::store3(sum.torque)};
}

}  // namespace brickfall
