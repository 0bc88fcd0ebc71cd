#include "contact_checks.h"

#include <algorithm>

#include "geometry/queries.h"

namespace brickfall::test {

Shape boxShape(Vec3 halfExtents) {
  Shape s;
  s.type = ShapeType::box;
  s.halfExtents = halfExtents;
  return s;
}
Shape sphereShape(double radius) {
  Shape s;
  s.type = ShapeType::sphere;
  s.radius = radius;
  return s;
}
Shape capsuleShape(double radius, double halfHeight) {
  Shape s;
  s.type = ShapeType::capsule;
  s.radius = radius;
  s.halfHeight = halfHeight;
  return s;
}
Shape hullShape(const Hull& hull) {
  Shape s;
  s.type = ShapeType::hull;
  s.hull = &hull;
  return s;
}
Shape planeShape() {
  Shape s;
  s.type = ShapeType::plane;
  return s;
}

Vec3 randomHalfExtents(Random& random) {
  return {random.between(0.02, 0.3), random.between(0.02, 0.3), random.between(0.02, 0.3)};
}
Hull randomHull(Random& random, int points) {
  for (;;) {
    Vec3 scale = randomHalfExtents(random);
    std::vector<Vec3> cloud;
    for (int i = 0; i < points; i++) cloud.push_back(scaled(randomDirection(random), scale));
    Result<Hull> hull = buildHull(cloud);
    if (hull.ok()) return hull.value();
  }
}

std::vector<Vec3> cornersOf(const Shape& shape, const Transform& pose) {
  std::vector<Vec3> corners;
  if (shape.type == ShapeType::hull) {
    for (Vec3 v : shape.hull->vertices) corners.push_back(transformPoint(pose, v));
  } else {
    for (int k = 0; k < 8; k++) {
      Vec3 sign{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0};
      corners.push_back(transformPoint(pose, scaled(sign, shape.halfExtents)));
    }
  }
  return corners;
}

std::vector<Vec3> faceNormalsOf(const Shape& shape, const Transform& pose) {
  std::vector<Vec3> normals;
  if (shape.type == ShapeType::hull) {
    for (const HullPlane& plane : shape.hull->planes) normals.push_back(rotate(pose.rotation, plane.normal));
  } else {
    for (int k = 0; k < 6; k++) {
      Vec3 n;
      n[k / 2] = k & 1 ? 1 : -1;
      normals.push_back(rotate(pose.rotation, n));
    }
  }
  return normals;
}

std::vector<Vec3> edgeDirectionsOf(const Shape& shape, const Transform& pose) {
  std::vector<Vec3> directions;
  if (shape.type == ShapeType::hull) {
    const Hull& hull = *shape.hull;
    for (size_t e = 0; e < hull.edges.size(); e += 2)
      directions.push_back(rotate(
          pose.rotation, normalized(hull.vertices[hull.edges[e + 1].origin] - hull.vertices[hull.edges[e].origin])));
  } else {
    directions = {rotate(pose.rotation, {1, 0, 0}), rotate(pose.rotation, {0, 1, 0}), rotate(pose.rotation, {0, 0, 1})};
  }
  return directions;
}

namespace {

double along(const std::vector<Vec3>& a, const std::vector<Vec3>& b, Vec3 axis) {
  double highA = -1e30, lowB = 1e30;
  for (Vec3 p : a) highA = std::max(highA, dot(p, axis));
  for (Vec3 p : b) lowB = std::min(lowB, dot(p, axis));
  return lowB - highA;
}

}  // namespace

Separation slowSeparation(const Shape& a, const Shape& b, const Transform& bInA) {
  std::vector<Vec3> ca = cornersOf(a, {}), cb = cornersOf(b, bInA);
  Separation best;
  auto test = [&](Vec3 axis, bool edge) {
    double s = along(ca, cb, axis);
    if (s > best.value) best = {s, axis, edge};
  };
  for (Vec3 n : faceNormalsOf(a, {})) test(n, false);
  for (Vec3 n : faceNormalsOf(b, bInA)) test(-n, false);
  for (Vec3 u : edgeDirectionsOf(a, {}))
    for (Vec3 v : edgeDirectionsOf(b, bInA)) {
      Vec3 axis = cross(u, v);
      double l = length(axis);
      if (l < 1e-6) continue;
      test(axis * (1 / l), true);
      test(axis * (-1 / l), true);
    }
  return best;
}

double distanceByGjk(const Shape& shape, Vec3 point) {
  return shapeDistance(shape, sphereShape(0), {point, {}}).distance;
}

namespace {

// Distance of a point from the solid shape, frame of the shape.
double outside(const Shape& shape, Vec3 p) {
  switch (shape.type) {
    case ShapeType::box:
      return length(max(abs(p) - shape.halfExtents, Vec3{}));
    case ShapeType::sphere:
      return std::max(0.0, length(p) - shape.radius);
    case ShapeType::capsule:
      return std::max(0.0, length(p - Vec3{0, std::clamp(p.y, -shape.halfHeight, shape.halfHeight), 0}) - shape.radius);
    case ShapeType::plane:
      return std::max(0.0, p.y);
    case ShapeType::hull: {
      double most = 0;
      for (const HullPlane& plane : shape.hull->planes) most = std::max(most, dot(plane.normal, p) - plane.offset);
      return most;
    }
    case ShapeType::cylinder:
    case ShapeType::cone:
      return length(closestPoint(shape, p) - p);
    case ShapeType::mesh:
      break;  // not asked here: it is no solid
  }
  return 0;
}

}  // namespace

std::string faultOf(const Manifold& m, const Shape& a, const Shape& b, const Transform& bInA, double margin,
                    double tolerance) {
  if (m.count < 0 || m.count > kMaxManifoldPoints) return "count " + std::to_string(m.count);
  if (m.count == 0) return "";
  if (std::fabs(length(m.normal) - 1) > 1e-12) return "normal not unit";
  Transform aInB = inverse(bInA);
  double offsetA = dot(m.normal, m.points[0].onA), offsetB = dot(m.normal, m.points[0].onB);
  bool planar = true;  // each point in the plane through the first, on one of the two shapes
  for (int i = 0; i < m.count; i++) {
    const ManifoldPoint& p = m.points[i];
    if (!isFinite(p.onA) || !isFinite(p.onB)) return "not finite";
    if (length(p.onB - p.onA - m.normal * p.separation) > 1e-12) return "points are not along the normal";
    if (p.separation > margin + 1e-12) return "separation over the margin";
    if (double d = outside(a, p.onA); d > tolerance) return "onA is outside a by " + std::to_string(d);
    if (double d = outside(b, transformPoint(aInB, p.onB)); d > tolerance)
      return "onB is outside b by " + std::to_string(d);
    planar = planar &&
             (std::fabs(dot(m.normal, p.onA) - offsetA) < 1e-9 || std::fabs(dot(m.normal, p.onB) - offsetB) < 1e-9);
    for (int k = 0; k < i; k++)
      if (m.points[k].feature == p.feature) return "two points of one name";
  }
  if (!planar) return "points are on no plane";
  return "";
}

double deepest(const Manifold& m) {
  double least = 1e30;
  for (int i = 0; i < m.count; i++) least = std::min(least, m.points[i].separation);
  return least;
}

Manifold swapped(const Shape& a, const Shape& b, const Transform& bInA, double margin) {
  Manifold m;
  collide(b, a, inverse(bInA), margin, m);
  m.normal = -rotate(bInA.rotation, m.normal);
  for (int i = 0; i < m.count; i++) {
    ManifoldPoint& p = m.points[i];
    Vec3 onA = transformPoint(bInA, p.onB), onB = transformPoint(bInA, p.onA);
    p.onA = onA;
    p.onB = onB;
  }
  return m;
}

}  // namespace brickfall::test
