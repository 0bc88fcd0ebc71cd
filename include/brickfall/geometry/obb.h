// Oriented boxes: the box itself, and what two of them say about each other at one instant. Usable without a World, in double
// (Obb) and single precision (ObbF).
#pragma once
#include <array>

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

}  // namespace brickfall
