// A symmetric positive definite 6 x 6 system, unknowns (translation, rotation): one rigid body or cluster.
#pragma once
#include "solver/solve_body.h"

namespace brickfall {

struct Symmetric6 {
  float a[21] = {};  // lower triangle by rows

  float& at(int row, int col) { return a[row * (row + 1) / 2 + col]; }
  float at(int row, int col) const { return a[row * (row + 1) / 2 + col]; }

  // LDL^T in place, inverse pivots on the diagonal. False if not positive definite.
  bool factor() {
    for (int j = 0; j < 6; j++) {
      float pivot = at(j, j);
      float unscaled[6];
      for (int k = 0; k < j; k++) {
        unscaled[k] = at(j, k);
        at(j, k) = unscaled[k] * at(k, k);
        pivot -= at(j, k) * unscaled[k];
      }
      if (!(pivot > 0)) return false;
      at(j, j) = 1 / pivot;
      for (int i = j + 1; i < 6; i++) {
        float s = at(i, j);
        for (int k = 0; k < j; k++) s -= at(i, k) * at(j, k);
        at(i, j) = s;
      }
    }
    return true;
  }

  // With the factor.
  Wrench solve(const Wrench& right) const {
    float x[6] = {right.force.x, right.force.y, right.force.z, right.torque.x, right.torque.y, right.torque.z};
    for (int i = 1; i < 6; i++)
      for (int k = 0; k < i; k++) x[i] -= at(i, k) * x[k];
    for (int i = 0; i < 6; i++) x[i] *= at(i, i);
    for (int i = 4; i >= 0; i--)
      for (int k = i + 1; k < 6; k++) x[i] -= at(k, i) * x[k];
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  }
};

}  // namespace brickfall
