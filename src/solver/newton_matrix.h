// The Newton matrix of a rigid cluster: its inertia and the stiffness of the rows of its boundary.
#pragma once
#include "solver/hierarchy.h"
#include "solver/reaction.h"
#include "solver/symmetric6.h"

namespace brickfall {

// The Newton matrix as sums over rows, by lines of three in four lanes. With a row's stiffness [A B; B^T C] seen at
// arm r from the cluster's centre (u = d - [r] th, w = th):
//   dd: A,   th d: [r] A + B^T,   th th: [r] A [r]^T + [r] B + ([r] B)^T + C.
// The transposed parts are summed untransposed and turned over once at the end.
struct MatrixSums {
  using V = wide::V;
  V dd[3] = {}, thd[3] = {}, B[3] = {}, thth[3] = {}, rB[3] = {};

  // [r] M by rows
  template <class L> static BRICKFALL_LANES void crossRows(L r, const L* m, L* out) {
    using wide::spread;
    L x = spread<0>(r), y = spread<1>(r), z = spread<2>(r);
    out[0] = y * m[2] - z * m[1];
    out[1] = z * m[0] - x * m[2];
    out[2] = x * m[1] - y * m[0];
  }
  // The row in the low half first.
  template <class L> static BRICKFALL_LANES void addHalves(V& sum, L pair, bool two) {
    sum += lowOf(pair);
    if (two) sum += highOf(pair);
  }

  // Adds two rows side by side (math/wide_pair.h), or only the row in the low half.
  template <class L> BRICKFALL_LANES void add(const StiffnessOf<L>& k, L r, bool two) {
    L rA[3], rBk[3];
    crossRows(r, k.A, rA);
    crossRows(r, k.B, rBk);
    for (int i = 0; i < 3; i++) {
      addHalves(dd[i], k.A[i], two);
      addHalves(thd[i], rA[i], two);
      addHalves(B[i], k.B[i], two);
      addHalves(thth[i], cross3(r, rA[i]) + k.C[i], two);
      addHalves(rB[i], rBk[i], two);
    }
  }

  void write(Symmetric6& H) const {
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) H.at(i, j) = dd[i][j];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) H.at(3 + i, j) = thd[i][j] + B[j][i];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) H.at(3 + i, 3 + j) = thth[i][j] + (rB[i][j] + rB[j][i]);
  }
};

inline void addInertia(Symmetric6& H, const Cluster& c) {
  for (int i = 0; i < 3; i++) H.at(i, i) += c.mass;
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) H.at(3 + i, 3 + j) += c.inertia[at++];
}

}  // namespace brickfall
