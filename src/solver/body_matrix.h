// The Newton matrix of single bodies, 6 rows each, in an envelope: their inertia, and the stiffness of rows on them.
#pragma once
#include <utility>

#include "solver/block_envelope.h"
#include "solver/reaction.h"
#include "solver/solve_body.h"

namespace brickfall {

inline constexpr std::uint32_t kNoPlace = 0xffffffffu;  // of a body that is not in the matrix

// J(left)^T K J(right) times sign, where J = [1 -[r]; 0 1] gives (u, w) at the row from a body's (d, th). K is
// symmetric.
inline void congruence(const BodyBlock& K, Vec3 left, Vec3 right, double sign, BodyBlock& out) {
  for (int i = 0; i < 6; i++) {
    const double x = K[i][0], y = K[i][1], z = K[i][2];
    out[0][i] = sign * x;
    out[1][i] = sign * y;
    out[2][i] = sign * z;
    out[3][i] = sign * (K[i][3] + (right.y * z - right.z * y));
    out[4][i] = sign * (K[i][4] + (right.z * x - right.x * z));
    out[5][i] = sign * (K[i][5] + (right.x * y - right.y * x));
  }
  for (auto& column : out) {
    const Vec3 t = cross(left, Vec3{column[0], column[1], column[2]});
    for (int k = 0; k < 3; k++) column[k + 3] += t[k];
  }
}

// Of a row between two bodies, with arms to it. kNoPlace: does not move.
struct MatrixEnd {
  std::uint32_t place = kNoPlace;
  Vec3 arm;  // m
};
inline void addTie(BlockEnvelope& matrix, const BodyBlock& K, MatrixEnd a, MatrixEnd b) {
  BodyBlock block;
  for (const MatrixEnd& end : {a, b}) {
    if (end.place == kNoPlace) continue;
    congruence(K, end.arm, end.arm, 1, block);
    matrix.add(end.place, end.place, block);
  }
  if (a.place == kNoPlace || b.place == kNoPlace) return;
  if (a.place < b.place) std::swap(a, b);
  congruence(K, a.arm, b.arm, -1, block);
  matrix.add(a.place, b.place, block);
}

inline void addBody(BlockEnvelope& matrix, std::uint32_t place, const SolveMass& m) {
  BodyBlock b = {};
  for (int k = 0; k < 3; k++) b[k][k] = double(m.mass);
  for (int row = 0, at = 0; row < 3; row++)
    for (int column = 0; column <= row; column++, at++)
      b[3 + row][3 + column] = b[3 + column][3 + row] = double(m.inertia[at]);
  matrix.add(place, place, b);
}

}  // namespace brickfall
