// Ray, closest point and overlap depth of single shapes, exact for every type. Meshes are surfaces (mesh_shape.h): nothing is
// inside one, and a ray hits it from either side.
#pragma once
#include <optional>

#include "geometry/shape.h"

namespace brickfall {

struct ShapeRayHit {
  Vec3 point, normal;   // shape frame; normal unit, out of the shape
  double distance = 0;  // m; 0 if the origin is inside (normal then against the ray)
};
// direction: unit, shape frame.
std::optional<ShapeRayHit> castRay(const Shape& shape, Vec3 origin, Vec3 direction, double maxDistance);

// Nearest point of the solid shape to `point` (shape frame); the point itself if inside.
Vec3 closestPoint(const Shape& shape, Vec3 point);

// Overlap depth, m: the shortest translation that separates the two; 0 when apart, and for two planes. Exact by SAT or
// closed form.
double penetrationDepth(const Shape& a, const Shape& b, const Transform& bInA);

struct DistanceResult {
  double distance = 0;  // m, 0 when touching or overlapping
  Vec3 onA, onB;        // closest points, frame of a (meaningless when overlapping)
};
// Distance of two convex shapes (GJK). Error below 1e-9 of the larger shape's size. Two planes: 0.
DistanceResult shapeDistance(const Shape& a, const Shape& b, const Transform& bInA);

// First time in [0, 1] at which b, moving from bInA by `motion` (frame of a, no rotation), comes within `target` m of a;
// nothing if it does not. 0 if it is that near already. Conservative advancement; it stops short by at most 1e-5 of the
// smaller inner radius or 1e-6 m, whichever is less, but not below 4e-9 of the larger shape, and never goes further in.
// Never for two planes.
std::optional<double> timeOfImpact(const Shape& a, const Shape& b, const Transform& bInA, Vec3 motion, double target);

}  // namespace brickfall
