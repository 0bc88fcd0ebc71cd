// Oriented boxes: the box itself, and what two of them say about each other at one instant. Usable without a World, in
// double (Obb) and single precision (ObbF).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "brickfall/math.h"
#include "brickfall/result.h"

namespace brickfall {

template <class T> struct ObbT {
  Vec3T<T> centre;  // world, m
  Mat3T<T> axes;    // ROWS: the box's axes in world components; unit, orthogonal, right-handed
  Vec3T<T> halfExtents{T(.5), T(.5), T(.5)};  // along each axis, m, >= 0
};
using Obb = ObbT<double>;
using ObbF = ObbT<float>;

// A box of these half extents around the origin, seen through a pose (unit quaternion).
template <class T> inline ObbT<T> makeObb(const TransformT<T>& pose, Vec3T<T> halfExtents) {
  return {pose.position, transpose(toMatrix(pose.rotation)), halfExtents};
}

// World point of local coordinates (along the axes, from the centre, m), and back.
template <class T> inline Vec3T<T> toWorld(const ObbT<T>& box, Vec3T<T> local) {
  return box.centre + transposeTimes(box.axes, local);
}
template <class T> inline Vec3T<T> toLocal(const ObbT<T>& box, Vec3T<T> world) {
  return box.axes * (world - box.centre);
}

// Corner k: coordinate i is +halfExtents[i] if bit i of k is set, else -halfExtents[i].
template <class T> inline std::array<Vec3T<T>, 8> corners(const ObbT<T>& box) {
  std::array<Vec3T<T>, 8> out;
  for (int k = 0; k < 8; k++) {
    Vec3T<T> local;
    for (int i = 0; i < 3; i++) local[i] = k >> i & 1 ? box.halfExtents[i] : -box.halfExtents[i];
    out[k] = toWorld(box, local);
  }
  return out;
}

// Error invalidArgument unless everything is finite, no half extent negative, and the axes are unit, orthogonal and
// right-handed to 1e-6 (double) or 1e-4 (float). `name` starts the message: "box.axes: ...". Functions below that return a
// Result or Status call this; the others take its success for granted (an invalid box gives a meaningless answer, never
// undefined behaviour).
template <class T> Status checkObb(const ObbT<T>& box, const char* name = "box");

// --- two boxes, A and B
//
// Fifteen axes decide (Gottschalk, Lin, Manocha 1996; the report's table of tests, whose test number is the row plus one):
// rows 0..2 the axes of A, 3..5 those of B, 6 + 3 i + j the cross product A_i x B_j. Two boxes that touch overlap. Where
// A_i and B_j are parallel to 3e-8 rad (double) or 1e-3 (float), their cross product says nothing and its row is skipped:
// the axes of the faces cover it. docs/geometry.md has all conventions.

constexpr int kObbRows = 15;
constexpr int kObbFaceRows = 6;
// "A0" .. "B2", "A0xB0" .. "A2xB2"
const char* obbRowName(int row);
// The row's axis in world components, NOT of unit length: |A_i x B_j| is the sine of the angle between the two.
template <class T> Vec3T<T> obbRowAxis(const ObbT<T>& a, const ObbT<T>& b, int row);

// The yes-or-no test: stops at the first row that separates.
template <class T> bool overlaps(const ObbT<T>& a, const ObbT<T>& b);
// out[k] = 1 if a[k] and b[k] overlap, else 0, to the bit as overlaps() says; four pairs at a time. All three spans of one
// length (anything beyond the shortest is left alone).
void overlaps(std::span<const ObbF> a, std::span<const ObbF> b, std::span<std::uint8_t> out);
// First row, in the order of the table, that separates; -1 if none does: the boxes overlap.
template <class T> int firstSeparatingRow(const ObbT<T>& a, const ObbT<T>& b);

// What every row says.
template <class T> struct ObbGapsT {
  std::array<T, kObbRows> gap{};              // > 0 how far apart, < 0 how deep, along the unit axis, m; 0 if skipped
  std::array<std::int8_t, kObbRows> sigma{};  // +1 if B's centre is on the positive side of the axis, else -1
  std::uint16_t used = 0;                     // bit k: row k was not skipped
  std::uint16_t separating = 0;               // bit k: row k separates
};
template <class T> ObbGapsT<T> rowGaps(const ObbT<T>& a, const ObbT<T>& b);

// The shortest push that takes two overlapping boxes apart. Rows within 1e-9 of the size (double; float 1e-5) of the least
// depth count as equal; of those the first one wins, so a face before an edge pair.
template <class T> struct ObbPenetrationT {
  int row = -1;
  T depth = 0;            // m, >= 0
  Vec3T<T> normal;        // unit, from A to B
  bool signKnown = true;  // false: the centres lie level along the axis, and either sign would do
};
// Nothing if the boxes are apart.
template <class T> std::optional<ObbPenetrationT<T>> leastPenetration(const ObbT<T>& a, const ObbT<T>& b);

// Closest points; of overlapping boxes distance 0 and a common point.
template <class T> struct ObbDistanceT {
  T distance = 0;  // m
  Vec3T<T> onA, onB;
};
template <class T> ObbDistanceT<T> distance(const ObbT<T>& a, const ObbT<T>& b);

// Everything above in one call, with the boxes checked.
template <class T> struct ObbPairT {
  bool overlap = false;
  int firstSeparating = -1;
  ObbGapsT<T> gaps;
  ObbDistanceT<T> closest;
  std::optional<ObbPenetrationT<T>> penetration;
};
template <class T> Result<ObbPairT<T>> examine(const ObbT<T>& a, const ObbT<T>& b);

}  // namespace brickfall
