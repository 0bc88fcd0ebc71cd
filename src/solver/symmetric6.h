// A symmetric positive definite 6 x 6 system, unknowns (translation, rotation): one rigid body or cluster.
#pragma once
#include "solver/solve_body.h"

namespace brickfall {

struct Symmetric6 {
  float a[21] = {};  // lower triangle by rows

  float& at(int row, int col) { return a[row * (row + 1) / 2 + col]; }
  float at(int row, int col) const { return a[row * (row + 1) / 2 + col]; }

  // LDL^T in place, inverse pivots on the diagonal. False if not positive definite. Column by column: each is taken off
  // all that are left as soon as it is known. The loops have known length and are laid out flat, so that the entries
  // stay in registers.
  bool factor() {
    bool positive = true;
#pragma GCC unroll 6
    for (int k = 0; k < 6; k++) {
      positive = positive && at(k, k) > 0;
      float inverse = 1 / at(k, k);
      at(k, k) = inverse;
#pragma GCC unroll 6
      for (int j = k + 1; j < 6; j++) {
        float scaled = at(j, k) * inverse;
#pragma GCC unroll 6
        for (int i = j; i < 6; i++) at(i, j) -= at(i, k) * scaled;
        at(j, k) = scaled;
      }
    }
    return positive;
  }

  // Solves with the factor.
  Wrench solve(const Wrench& right) const {
    float x[6] = {right.force.x, right.force.y, right.force.z, right.torque.x, right.torque.y, right.torque.z};
#pragma GCC unroll 6
    for (int i = 1; i < 6; i++)
#pragma GCC unroll 6
      for (int k = 0; k < i; k++) x[i] -= at(i, k) * x[k];
#pragma GCC unroll 6
    for (int i = 0; i < 6; i++) x[i] *= at(i, i);
#pragma GCC unroll 6
    for (int i = 4; i >= 0; i--)
#pragma GCC unroll 6
      for (int k = i + 1; k < 6; k++) x[i] -= at(k, i) * x[k];
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  }
};

}  // namespace brickfall
