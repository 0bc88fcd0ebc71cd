// The Newton matrix of single bodies, 6 rows each, in an envelope: their inertia, and the stiffness of rows on them.
#pragma once
#include <utility>

#include "solver/block_envelope.h"
#include "solver/reaction.h"
#include "solver/solve_body.h"

namespace brickfall {

using BodyBlock = double[6][6];

inline constexpr std::uint32_t kNoPlace = 0xffffffffu;  // of a body that is not in the matrix

// J(left)^T K J(right) times sign, where J = [1 -[r]; 0 1] gives (u, w) at the row from a body's (d, th).
inline void congruence(const BodyBlock& K, Vec3 left, Vec3 right, double sign, BodyBlock& out) {
  for (int i = 0; i < 6; i++) {
    Vec3 d{K[i][0], K[i][1], K[i][2]}, t = Vec3{K[i][3], K[i][4], K[i][5]} + cross(right, d);
    for (int k = 0; k < 3; k++) {
      out[i][k] = sign * d[k];
      out[i][k + 3] = sign * t[k];
    }
  }
  for (int j = 0; j < 6; j++) {
    Vec3 t = cross(left, Vec3{out[0][j], out[1][j], out[2][j]});
    for (int k = 0; k < 3; k++) out[k + 3][j] += t[k];
  }
}

inline void addBody(BlockEnvelope& matrix, std::uint32_t place, const SolveMass& m) {
  BodyBlock b = {};
  for (int k = 0; k < 3; k++) b[k][k] = double(m.mass);
  for (int row = 0, at = 0; row < 3; row++)
    for (int column = 0; column <= row; column++, at++)
      b[3 + row][3 + column] = b[3 + column][3 + row] = double(m.inertia[at]);
  matrix.add(place, place, b);
}

// placeOf(body) is kNoPlace for bodies that do not move.
template <class PlaceOf> void addRow(BlockEnvelope& matrix, RowEnds rowEnds, const StiffReaction& x, PlaceOf placeOf) {
  const Stiffness& s = x.stiffness;
  BodyBlock K, b;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      K[i][j] = double(s.A[i][j]);
      K[i][j + 3] = K[j + 3][i] = double(s.B[i][j]);
      K[i + 3][j + 3] = double(s.C[i][j]);
    }
  struct End {
    std::uint32_t place;
    Vec3 arm;
  } ends[2] = {{placeOf(rowEnds.a), toDouble(wide::store3(x.armA))},
               {placeOf(rowEnds.b), toDouble(wide::store3(x.armB))}};
  for (const End& end : ends) {
    if (end.place == kNoPlace) continue;
    congruence(K, end.arm, end.arm, 1, b);
    matrix.add(end.place, end.place, b);
  }
  if (ends[0].place == kNoPlace || ends[1].place == kNoPlace) return;
  if (ends[0].place < ends[1].place) std::swap(ends[0], ends[1]);
  congruence(K, ends[0].arm, ends[1].arm, -1, b);
  matrix.add(ends[0].place, ends[1].place, b);
}

}  // namespace brickfall
