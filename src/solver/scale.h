// The scale on which lengths, speeds and times are judged. The method's constants are given for one brick under the
// gravity of the Earth; for other bodies, or another gravity, they are in proportion. So a scene with all lengths x s,
// gravity x g and times x sqrt(s / g) gives the same picture.
#pragma once
#include <algorithm>
#include <cmath>

#include "brickfall/math.h"

namespace brickfall {

//! not of the method: inner radius (m) of the brick, gravity (m/s2) and time step (s) for which the constants are given
inline constexpr double kReferenceSize = 0.0325, kReferenceGravity = 9.81, kReferenceStep = 1.0 / 60;

struct Scale {
  double size = kReferenceSize;            // m, an inner radius
  double gravity = kReferenceGravity;      // m/s2
  double length = 1, speed = 1, time = 1;  // x the method's: as size, sqrt(gravity size), sqrt(size / gravity)

  // The scale of a body in an island of this scale. A larger body moves the others by its motion, so it is judged on
  // their scale. A smaller body is judged on its own.
  Scale ofBody(double innerRadius) const;
};

inline Scale scaleOf(double size, double gravity) {
  const double length = size / kReferenceSize, weight = gravity / kReferenceGravity;
  return {size, gravity, length, std::sqrt(length * weight), std::sqrt(length / weight)};
}
inline Scale Scale::ofBody(double innerRadius) const {
  return innerRadius < size ? scaleOf(innerRadius, gravity) : *this;
}

// Scale of lengths (x the method's) for two bodies or shapes of these inner radii. The thinner one decides.
inline double lengthScale(double one, double other) { return std::min(one, other) / kReferenceSize; }

// m/s2: the gravity by which weights are judged. Without gravity bodies have no weight and no time of their own: then
// it is the Earth's.
inline double judgingGravity(Vec3 gravity) {
  const double g = brickfall::length(gravity);
  return g > 0 ? g : kReferenceGravity;
}

}  // namespace brickfall
