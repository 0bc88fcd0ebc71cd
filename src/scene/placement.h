// Where a table of a group or of a repetition stands: turned about the vertical, then moved.
#pragma once
#include <cmath>
#include <numbers>

#include "brickfall/math.h"

namespace brickfall::scene {

struct Placement {
  Vec3 position;          // m
  double yawDegrees = 0;  // about +y

  bool moves() const { return !(position == Vec3{} && yawDegrees == 0); }
};

// Turns about the world's x, then y, then z axis.
inline Quat rotationFromDegrees(Vec3 degrees) {
  const Quat x = quatFromAxisAngle({1, 0, 0}, degrees.x * (std::numbers::pi / 180));
  const Quat y = quatFromAxisAngle({0, 1, 0}, degrees.y * (std::numbers::pi / 180));
  const Quat z = quatFromAxisAngle({0, 0, 1}, degrees.z * (std::numbers::pi / 180));
  return normalized(z * y * x);
}

// Quarter turns are exact.
inline Vec3 turned(Vec3 v, double yawDegrees) {
  const double quarters = yawDegrees / 90;
  double sine = 0, cosine = 1;
  if (quarters == std::floor(quarters)) {
    const int quarter = int(quarters - 4 * std::floor(quarters / 4));
    sine = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
    cosine = quarter == 0 ? 1 : quarter == 2 ? -1 : 0;
  } else {
    sinCos(yawDegrees * (std::numbers::pi / 180), sine, cosine);
  }
  return {cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x};
}
inline Vec3 placedPoint(const Placement& at, Vec3 p) {
  return (at.yawDegrees == 0 ? p : turned(p, at.yawDegrees)) + at.position;
}
inline Vec3 placedDirection(const Placement& at, Vec3 v) { return at.yawDegrees == 0 ? v : turned(v, at.yawDegrees); }
inline Placement operator*(const Placement& outer, const Placement& inner) {
  return {placedPoint(outer, inner.position), outer.yawDegrees + inner.yawDegrees};
}

}  // namespace brickfall::scene
