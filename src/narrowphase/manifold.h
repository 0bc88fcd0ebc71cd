// The contact of two convex shapes: a plane of up to four points.
#pragma once
#include <cstdint>

#include "brickfall/math.h"

namespace brickfall {

constexpr int kMaxManifoldPoints = 4;

struct ManifoldPoint {
  Vec3 onA, onB;              // on the two surfaces, frame of shape A; onB - onA = separation * normal
  double separation = 0;      // m along the normal; negative = overlap
  std::uint32_t feature = 0;  // which corner or edges made the point: the same number as long as these do
};

struct Manifold {
  Vec3 normal;    // unit, from A to B, frame of shape A
  int count = 0;  // 0 = further apart than the margin
  ManifoldPoint points[kMaxManifoldPoints];
};

}  // namespace brickfall
