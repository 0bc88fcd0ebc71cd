#include "shape_samples.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace brickfall::test {

Shape ShapeSamples::makeHull(const std::vector<Vec3>& points) {
  Result<Hull> hull = buildHull(points);
  EXPECT_TRUE(hull) << hull.error().message;
  hulls_.push_back(hull ? *hull : Hull{});
  Shape shape;
  shape.type = ShapeType::hull;
  shape.hull = &hulls_.back();
  return shape;
}

Shape ShapeSamples::make(ShapeType type) {
  auto size = [&] { return random_.between(0.05, 1); };
  Shape shape;
  shape.type = type;
  switch (type) {
    case ShapeType::box: {
      double x = size(), y = size();
      shape.halfExtents = {x, y, size()};
      break;
    }
    case ShapeType::sphere:
      shape.radius = size();
      break;
    case ShapeType::capsule:
      shape.radius = size();
      shape.halfHeight = size();
      break;
    case ShapeType::cylinder:
    case ShapeType::cone:
      shape.radius = size();
      shape.halfHeight = size();
      if (type == ShapeType::cone && random_.below(2) == 0) shape.topRadius = size();
      break;
    case ShapeType::hull: {
      double x = size(), y = size();
      Vec3 axes{x, y, size()};
      int count = 4 + int(random_.below(30));
      std::vector<Vec3> points = randomPoints(random_, count, axes, random_.below(2) == 0);
      Vec3 shift = randomVector(random_, 0.3);
      for (Vec3& p : points) p += shift;
      return makeHull(points);
    }
    case ShapeType::plane:
    case ShapeType::mesh:
      break;
  }
  return shape;
}

Outline outlineOf(const Shape& shape) {
  Outline out;
  switch (shape.type) {
    case ShapeType::box:
      for (int k = 0; k < 8; k++) {
        Vec3 h = shape.halfExtents;
        out.corners.push_back({k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
      }
      for (int k = 0; k < 8; k++) {
        for (int bit : {1, 2, 4}) {
          if (!(k & bit)) out.edges.push_back({out.corners[std::size_t(k)], out.corners[std::size_t(k | bit)]});
        }
      }
      break;
    case ShapeType::sphere:
      out.corners = {{}};
      out.radius = shape.radius;
      break;
    case ShapeType::capsule:
      out.corners = {{0, -shape.halfHeight, 0}, {0, shape.halfHeight, 0}};
      out.edges = {{out.corners[0], out.corners[1]}};
      out.radius = shape.radius;
      break;
    case ShapeType::hull:
      out.corners = shape.hull->vertices;
      for (std::size_t e = 0; e < shape.hull->edges.size(); e += 2) {
        const Hull& hull = *shape.hull;
        out.edges.push_back({hull.vertices[hull.edges[e].origin], hull.vertices[hull.edges[e + 1].origin]});
      }
      break;
    case ShapeType::cylinder:
    case ShapeType::cone:
    case ShapeType::plane:
    case ShapeType::mesh:
      break;  // no polytopes
  }
  return out;
}

double segmentDistance(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  auto pointToSegment = [](Vec3 p, Vec3 q, Vec3 r) {
    double t = std::clamp(dot(p - q, r - q) / lengthSquared(r - q), 0.0, 1.0);
    return length(p - (q + (r - q) * t));
  };
  double best =
      std::min({pointToSegment(a, c, d), pointToSegment(b, c, d), pointToSegment(c, a, b), pointToSegment(d, a, b)});
  Vec3 u = b - a, v = d - c, n = cross(u, v);
  double squared = lengthSquared(n);
  if (squared > 1e-20 * lengthSquared(u) * lengthSquared(v)) {
    double s = dot(cross(c - a, v), n) / squared, t = dot(cross(c - a, u), n) / squared;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, length(a + u * s - (c + v * t)));
  }
  return best;
}

}  // namespace brickfall::test
