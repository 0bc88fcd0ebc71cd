// Sweeps over blocks: for block_rows.cpp and face/pairs_avx2.cpp, which differ in their lanes. A block's column and six
// numbers are twice four lanes each: force, torque.
#pragma once
#include "math/wide_pair.h"
#include "solver/block_sweeps.h"

namespace brickfall::blocks {

template <class L> BRICKFALL_LANES L of(const Wrench& x) { return L(wide::load(&x.force.x), wide::load(&x.torque.x)); }
template <class L> BRICKFALL_LANES void storeTo(Wrench& x, L six) {
  wide::store(lowOf(six), &x.force.x);
  wide::store(highOf(six), &x.torque.x);
}

// sum - block x
template <class L> BRICKFALL_LANES L less(L sum, const Block6& block, const Wrench& x) {
  const float parts[6] = {x.force.x, x.force.y, x.force.z, x.torque.x, x.torque.y, x.torque.z};
#pragma GCC unroll 6
  for (int j = 0; j < 6; j++) sum = sum - of<L>(block.of[j]) * wide::all<L>(parts[j]);
  return sum;
}
// block x, as two sums of three: what follows waits for less.
template <class L> BRICKFALL_LANES L times(const Block6& block, const Wrench& x) {
  const L even = of<L>(block.of[0]) * wide::all<L>(x.force.x) + of<L>(block.of[2]) * wide::all<L>(x.force.z) +
                 of<L>(block.of[4]) * wide::all<L>(x.torque.y);
  const L odd = of<L>(block.of[1]) * wide::all<L>(x.force.y) + of<L>(block.of[3]) * wide::all<L>(x.torque.x) +
                of<L>(block.of[5]) * wide::all<L>(x.torque.z);
  return even + odd;
}

// right -= block^T x of the blocks of a row: what it does to those before it.
template <class L> BRICKFALL_LANES void giveEarlier(const BlockView& m, std::uint32_t row, L x, Wrench* right) {
  const L none = wide::all<L>(0);
  for (std::uint32_t k = m.begin[row]; k < m.begin[row + 1]; k++) {
    const Block6& b = m.blocks[k];
    Wrench& to = right[m.list[k]];
    const L force = sums(of<L>(b.of[0]) * x, of<L>(b.of[1]) * x, of<L>(b.of[2]) * x, none);
    const L torque = sums(of<L>(b.of[3]) * x, of<L>(b.of[4]) * x, of<L>(b.of[5]) * x, none);
    wide::store(wide::load(&to.force.x) - (lowOf(force) + highOf(force)), &to.force.x);
    wide::store(wide::load(&to.torque.x) - (lowOf(torque) + highOf(torque)), &to.torque.x);
  }
}
// Solves a row for its own unknowns, with those before it as they are.
template <class L> BRICKFALL_LANES L settle(const BlockView& m, std::uint32_t row, const Wrench& right, Wrench* x) {
  L sum = of<L>(right);
  for (std::uint32_t k = m.begin[row]; k < m.begin[row + 1]; k++) sum = less(sum, m.blocks[k], x[m.list[k]]);
  Wrench rest;
  storeTo(rest, sum);
  const L found = times<L>(m.inverses[row], rest);
  storeTo(x[row], found);
  return found;
}

template <class L> void forwards(const BlockView& m, const Wrench* right, Wrench* x, Wrench* left) {
  for (std::uint32_t row = 0; row < m.rows; row++) giveEarlier(m, row, settle<L>(m, row, right[row], x), left);
}
template <class L> void backwards(const BlockView& m, Wrench* right, Wrench* x) {
  for (std::uint32_t row = m.rows; row-- > 0;) giveEarlier(m, row, settle<L>(m, row, right[row], x), right);
}
template <class L>
void multiply(const BlockView& m, const Wrench* right, const Wrench* from, const Wrench* x, Wrench* out) {
  for (std::uint32_t row = 0; row < m.rows; row++) {
    L sum = of<L>(right[row]);
    for (std::uint32_t k = m.begin[row]; k < m.begin[row + 1]; k++) {
      Wrench change;
      storeTo(change, of<L>(from[m.list[k]]) - of<L>(x[m.list[k]]));
      sum = less(sum, m.blocks[k], change);
    }
    storeTo(out[row], sum);
  }
}

// Row k of what is left is solved for its own unknown, and taken off all others (Gauss and Jordan). Pivots are those of
// any elimination: all are positive where the matrix is positive definite.
template <int k, class L> BRICKFALL_LANES bool eliminate(L (&rows)[6]) {
  auto entry = [](L row) { return k < 3 ? lowOf(row)[k % 3] : highOf(row)[k % 3]; };
  const wide::V one{k % 3 == 0 ? 1.0f : 0, k % 3 == 1 ? 1.0f : 0, k % 3 == 2 ? 1.0f : 0, 0}, none{};
  const L unit(k < 3 ? one : none, k < 3 ? none : one), others = wide::all<L>(1) - unit;
  const float pivot = entry(rows[k]), inverse = 1 / pivot;
  rows[k] = (rows[k] * others + unit) * wide::all<L>(inverse);
#pragma GCC unroll 6
  for (int i = 0; i < 6; i++)
    if (i != k) rows[i] = rows[i] * others - rows[k] * wide::all<L>(entry(rows[i]));
  return pivot > 0;
}
template <class L> bool invert(const Block6* blocks, std::uint32_t count, Block6* out) {
  bool positive = true;
  for (std::uint32_t n = 0; n < count; n++) {
    L rows[6];
#pragma GCC unroll 6
    for (int i = 0; i < 6; i++) rows[i] = of<L>(blocks[n].of[i]);
    positive = eliminate<0>(rows) && eliminate<1>(rows) && eliminate<2>(rows) && eliminate<3>(rows) &&
               eliminate<4>(rows) && eliminate<5>(rows) && positive;
#pragma GCC unroll 6
    for (int i = 0; i < 6; i++) storeTo(out[n].of[i], rows[i]);
  }
  return positive;
}

template <class L> SweepFunctions sweepFunctions() { return {forwards<L>, backwards<L>, multiply<L>, invert<L>}; }

}  // namespace brickfall::blocks
