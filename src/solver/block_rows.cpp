#include "solver/block_rows.h"

#include <algorithm>

#include "solver/block_sweeps_kernel.h"

namespace brickfall {

namespace {

SweepFunctions chooseSweeps() {
#if defined(__x86_64__)
  SweepFunctions eight = sweepsInEight();
  if (eight.forwards && __builtin_cpu_supports("avx2")) return eight;
#endif
  return sweepsInHalves();
}

}  // namespace

SweepFunctions sweepsInHalves() { return blocks::sweepFunctions<wide::Halves>(); }

const SweepFunctions& sweeps() {
  static const SweepFunctions functions = chooseSweeps();
  return functions;
}

double dotOf(const Wrenches& x, const Wrenches& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); i++) {
    wide::V part =
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

void BlockRows::shape(const Adjacency& neighbours) {
  earlier_.begin.assign(1, 0);
  earlier_.list.clear();
  for (std::uint32_t row = 0; row < neighbours.count(); row++) {
    for (std::uint32_t k = neighbours.begin[row]; k < neighbours.begin[row + 1]; k++)
      if (neighbours.list[k] < row) earlier_.list.push_back(neighbours.list[k]);
    earlier_.begin.push_back(std::uint32_t(earlier_.list.size()));
  }
  diagonal_.assign(neighbours.count(), Block{});
  inverses_.resize(neighbours.count());
  blocks_.assign(earlier_.list.size(), Block{});
}

void BlockRows::clear() {
  std::fill(diagonal_.begin(), diagonal_.end(), Block{});
  std::fill(blocks_.begin(), blocks_.end(), Block{});
}

bool BlockRows::invert() {
  return sweeps().invert(diagonal_.data(), std::uint32_t(diagonal_.size()), inverses_.data());
}

BlockView BlockRows::view() const {
  return {std::uint32_t(diagonal_.size()), earlier_.begin.data(), earlier_.list.data(), blocks_.data(),
          inverses_.data()};
}

void BlockRows::sweepForwards(const Wrenches& right, Wrenches& x, Wrenches& left) const {
  left.assign(right.size(), {});
  sweeps().forwards(view(), right.data(), x.data(), left.data());
}

void BlockRows::sweepBackwards(const Wrenches& right, Wrenches& x) {
  rest_.assign(right.begin(), right.end());
  sweeps().backwards(view(), rest_.data(), x.data());
}

void BlockRows::multiplySwept(const Wrenches& right, const Wrenches& from, const Wrenches& x, Wrenches& out) const {
  sweeps().multiply(view(), right.data(), from.data(), x.data(), out.data());
}

}  // namespace brickfall
