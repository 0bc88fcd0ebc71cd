// The fifteen rows of the separating axis test of two oriented boxes, from one rule instead of fifteen typed lines. With
// (i0, i1, i2) and (j0, j1, j2) cyclic shifts of (0, 1, 2), c[i][j] = A_i . B_j and L = A_i0 x B_j0:
//   L.A_i1 = -c[i2][j0]   L.A_i2 = +c[i1][j0]   L.B_j1 = +c[i0][j2]   L.B_j2 = -c[i0][j1]   L.A_i0 = L.B_j0 = 0
// Half extents and distances are projected on L, which for these rows is not of unit length. All is relative to A's
// centre, so that boxes far from the origin lose nothing but what their centres had lost.
#pragma once
#include <type_traits>
#include <utility>

#include "brickfall/geometry/obb.h"

namespace brickfall {

template <class T> constexpr bool kIsFloat = std::is_same_v<T, float>;
// Squared sine of the angle between two axes below which their row is skipped, each row for itself. Skipping hides gaps of
// about the sine times the size, and rounding on a row just above the limit makes gaps of about epsilon over the sine: this
// is where the two are equally small (docs/geometry.md has the measurements; 1e-12 in double would hide ten times more).
template <class T> constexpr T kParallelSquared = kIsFloat<T> ? T(1e-6) : T(1e-15);

template <class T> struct ObbRows {
  T c[3][3], m[3][3];  // A_i . B_j, and its absolute value
  Vec3T<T> a, b;       // half extents
  Vec3T<T> dA, dB;     // from A's centre to B's, along the axes of A and of B

  ObbRows(const ObbT<T>& boxA, const ObbT<T>& boxB) : a(boxA.halfExtents), b(boxB.halfExtents) {
    Vec3T<T> d = boxB.centre - boxA.centre;
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) {
        c[i][j] = dot(boxA.axes.row[i], boxB.axes.row[j]);
        m[i][j] = std::fabs(c[i][j]);
      }
    }
    dA = boxA.axes * d;
    dB = boxB.axes * d;
  }

  // |L|^2
  template <int row> T squared() const {
    if constexpr (row < kObbFaceRows) {
      return 1;
    } else {
      constexpr int i0 = (row - 6) / 3, i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3, j0 = (row - 6) % 3;
      return c[i1][j0] * c[i1][j0] + c[i2][j0] * c[i2][j0];
    }
  }
  // R0 + R1: half extents of both along L.
  template <int row> T reach() const {
    if constexpr (row < 3) {
      return a[row] + (b.x * m[row][0] + b.y * m[row][1] + b.z * m[row][2]);
    } else if constexpr (row < kObbFaceRows) {
      return b[row - 3] + (a.x * m[0][row - 3] + a.y * m[1][row - 3] + a.z * m[2][row - 3]);
    } else {
      constexpr int i0 = (row - 6) / 3, i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3;
      constexpr int j0 = (row - 6) % 3, j1 = (j0 + 1) % 3, j2 = (j0 + 2) % 3;
      return (a[i1] * m[i2][j0] + a[i2] * m[i1][j0]) + (b[j1] * m[i0][j2] + b[j2] * m[i0][j1]);
    }
  }
  // L . v, of a vector given along the axes of A and of B.
  template <int row> T along(Vec3T<T> vA, Vec3T<T> vB) const {
    if constexpr (row < 3) {
      return vA[row];
    } else if constexpr (row < kObbFaceRows) {
      return vB[row - 3];
    } else {
      constexpr int i0 = (row - 6) / 3, i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3, j0 = (row - 6) % 3;
      return c[i1][j0] * vA[i2] - c[i2][j0] * vA[i1];
    }
  }
  template <int row> bool used() const { return row < kObbFaceRows || squared<row>() > kParallelSquared<T>; }
};

// function(std::integral_constant<int, row>) for rows from..to-1, in order; a row that returns true ends it, and is
// returned. -1: none did.
template <int from, int to, class F> inline int firstRow(F&& function) {
  int found = -1;
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (void)((function(std::integral_constant<int, from + k>{}) && (found = from + k, true)) || ...);
  }
  (std::make_integer_sequence<int, to - from>{});
  return found;
}
template <class F> inline void eachRow(F&& function) {
  firstRow<0, kObbRows>([&](auto row) {
    function(row);
    return false;
  });
}

// Lengths that count as equal when rows are compared, as a share of the size |a| + |b|.
template <class T> constexpr T kTie = kIsFloat<T> ? T(1e-5) : T(1e-9);
template <class T> inline T pairSize(const ObbT<T>& a, const ObbT<T>& b) {
  return length(a.halfExtents) + length(b.halfExtents);
}

}  // namespace brickfall
