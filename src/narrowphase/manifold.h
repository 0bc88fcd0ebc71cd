// The contact of two convex shapes: a plane of up to four points.
#pragma once
#include <algorithm>
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
  bool partial = false;  // there are more than these
  bool rolls = false;    // its points are no fixed places of a cylinder or cone: they wander as it moves
};

// The points that carried force when two shapes were last seen. Where more than four corners touch, micrometres would decide which
// are kept; but where a point is left out that carries, its body falls until another one has taken over.
struct LoadedPoints {
  std::uint32_t features[kMaxManifoldPoints] = {};
  int count = 0;

  void add(std::uint32_t feature) { features[count++] = feature; }
  bool has(std::uint32_t feature) const { return std::find(features, features + count, feature) != features + count; }
};

}  // namespace brickfall
