// Conservative advancement. Without rotation the distance of two convex shapes is a convex function of time, and a step
// of distance / approach speed along the closest points' normal is a Newton step for it: it never passes the first
// contact, converges fast where the shapes really meet, and by halves where they only graze.
#include "geometry/core.h"
#include "geometry/mesh_shape.h"
#include "geometry/queries.h"

namespace brickfall {

namespace {

constexpr double kTolerance = 1e-6;      // m, at most
constexpr double kShareOfInner = 1e-5;   // of the smaller inner radius
constexpr double kShareOfExtent = 4e-9;  // of the larger shape: what its distance is exact to, and some
constexpr double kEndless = 1e29;        // planes
constexpr int kMaxSteps = 200;

// How near is there: what is nothing to a brick of 20 cm is much to a pebble of 1 mm. Points and triangles have no
// thickness, and planes no end: the other of the two decides.
double toleranceOf(const Shape& a, const Shape& b) {
  double tolerance = kTolerance, least = 0;
  for (const Shape* shape : {&a, &b}) {
    double inner = innerRadius(*shape), outer = outerRadius(*shape, {});
    if (inner > 0 && inner * kShareOfInner < tolerance) tolerance = inner * kShareOfInner;
    if (outer < kEndless && outer * kShareOfExtent > least) least = outer * kShareOfExtent;
  }
  return tolerance > least ? tolerance : least;
}

}  // namespace

std::optional<double> timeOfImpact(const Shape& a, const Shape& b, const Transform& bInA, Vec3 motion, double target) {
  if (a.type == ShapeType::plane && b.type == ShapeType::plane) return {};
  if (a.type == ShapeType::mesh) return meshTimeOfImpact(a, b, bInA, motion, target);
  if (b.type == ShapeType::mesh) {
    Transform aInB = inverse(bInA);
    return meshTimeOfImpact(b, a, aInB, -rotate(aInB.rotation, motion), target);
  }
  double wanted = target > 0 ? target : 0, time = 0, tolerance = toleranceOf(a, b);
  for (int step = 0; step < kMaxSteps; step++) {
    DistanceResult now = shapeDistance(a, b, {bInA.position + motion * time, bInA.rotation});
    if (now.distance <= wanted + tolerance) return time;
    double approach = dot(motion, now.onA - now.onB) / now.distance;  // m per unit of time
    if (!(approach > 0)) return {};
    time += (now.distance - wanted) / approach;
    if (!(time <= 1)) return {};
  }
  return time;
}

}  // namespace brickfall
