// Distance by GJK (Gilbert, Johnson, Keerthi 1988) between cores, in double precision; planes in closed form. Cores are
// points, segments and polytopes, so the search ends after finitely many corners; it stops as soon as the support in the
// search direction proves that nothing nearer is left, or rounding lets nothing nearer be found.
#include "geometry/core.h"
#include "geometry/mesh_shape.h"
#include "geometry/queries.h"
#include "geometry/simplex.h"

namespace brickfall {

namespace {

constexpr int kMaxIterations = 128;
constexpr double kGapTolerance = 1e-13;       // of the size: proven excess of the found distance
constexpr double kProgress = 1 + 1e-15;       // a corner may bring less than rounding shows and yet lead on to the next
constexpr double kApart = 1e-13;              // of the size and distance: such a support plane is no rounding
constexpr double kTouchingTolerance = 1e-14;  // of the size: nearer cores count as overlapping

// Shape b as seen from the frame of a.
struct Placed {
  const Shape& shape;
  Mat3 turn;
  Vec3 position;

  Placed(const Shape& placed, const Transform& pose)
      : shape(placed), turn(toMatrix(pose.rotation)), position(pose.position) {}
  Vec3 support(Vec3 direction) const { return turn * coreSupport(shape, transposeTimes(turn, direction)) + position; }
};

SimplexCorner supportPair(const Shape& a, const Placed& b, Vec3 direction) {
  SimplexCorner corner;
  corner.onA = coreSupport(a, direction);
  corner.onB = b.support(-direction);
  corner.point = corner.onA - corner.onB;
  return corner;
}

// Closest points of the cores.
DistanceResult coreDistance(const Shape& a, const Placed& b) {
  double size = coreSize(a) + coreSize(b.shape);
  Simplex simplex;
  simplex.corner[0] = supportPair(a, b, b.position);
  simplex.count = 1;
  reduce(simplex);
  Simplex best = simplex;
  bool apart = false;   // a plane between the cores was found: four corners in a plane cannot prove the contrary
  bool refined = true;  // search along best.direction, exact for near shapes; then along best.nearest, for slivers
  for (int iteration = 0; iteration < kMaxIterations; iteration++) {
    double distance = length(best.nearest);
    if (!(distance > kTouchingTolerance * size)) return {};
    Vec3 direction = refined ? best.direction : best.nearest * (1 / distance);
    SimplexCorner next = supportPair(a, b, -direction);
    double gap = distance - dot(direction, next.point);  // no point of A - B is nearer than distance - gap
    if (!(gap > kGapTolerance * size + 1e-15 * distance)) break;
    apart = apart || dot(direction, next.point) > kApart * (size + length(next.point));
    simplex = best;
    bool nearer = false;
    if (!best.has(next.point)) {
      simplex.corner[simplex.count++] = next;
      reduce(simplex, apart);
      if (simplex.hasOrigin) return {};
      nearer = lengthSquared(simplex.nearest) <= lengthSquared(best.nearest) * kProgress;
    }
    if (!nearer && !refined) break;
    refined = nearer;
    if (nearer) best = simplex;
  }
  DistanceResult out;
  out.distance = length(best.nearest);
  for (int k = 0; k < best.count; k++) {
    out.onA += best.corner[k].onA * best.corner[k].weight;
    out.onB += best.corner[k].onB * best.corner[k].weight;
  }
  return out;
}

// Height of the lowest point of b above the surface y = 0 of a plane, and the closest points, in the plane's frame.
DistanceResult planeDistance(const Shape& b, const Transform& bInPlane) {
  if (b.type == ShapeType::plane) return {};  // two planes never touch, and are never apart
  DistanceResult out;
  out.onB = Placed(b, bInPlane).support({0, -1, 0}) - Vec3{0, coreRadius(b), 0};
  out.onA = {out.onB.x, 0, out.onB.z};
  out.distance = out.onB.y > 0 ? out.onB.y : 0;
  return out;
}

}  // namespace

DistanceResult shapeDistance(const Shape& a, const Shape& b, const Transform& bInA) {
  if (a.type == ShapeType::mesh) return meshShapeDistance(a, b, bInA);
  if (b.type == ShapeType::mesh) {
    DistanceResult out = meshShapeDistance(b, a, inverse(bInA));
    return {out.distance, transformPoint(bInA, out.onB), transformPoint(bInA, out.onA)};
  }
  if (a.type == ShapeType::plane) return planeDistance(b, bInA);
  if (b.type == ShapeType::plane) {
    DistanceResult out = planeDistance(a, inverse(bInA));
    return {out.distance, transformPoint(bInA, out.onB), transformPoint(bInA, out.onA)};
  }
  DistanceResult out = coreDistance(a, Placed(b, bInA));
  double radii = coreRadius(a) + coreRadius(b);
  if (!(out.distance > radii)) return {};
  Vec3 normal = (out.onB - out.onA) * (1 / out.distance);
  out.distance -= radii;
  out.onA += normal * coreRadius(a);
  out.onB -= normal * coreRadius(b);
  return out;
}

}  // namespace brickfall
