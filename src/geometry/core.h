// Every convex shape is a core (point, segment, polytope, cylinder or cone) plus a ball of some radius. Distance and depth are
// found between cores, and the radii are put on at the end.
#pragma once
#include "geometry/frustum.h"
#include "geometry/hull.h"
#include "geometry/shape.h"

namespace brickfall {

inline double coreRadius(const Shape& shape) { return isRound(shape.type) ? shape.radius : 0; }

// The point of the core furthest along `direction`; of equals the first. Not for planes.
inline Vec3 coreSupport(const Shape& shape, Vec3 direction) {
  switch (shape.type) {
    case ShapeType::box: {
      Vec3 h = shape.halfExtents;
      return {direction.x < 0 ? -h.x : h.x, direction.y < 0 ? -h.y : h.y, direction.z < 0 ? -h.z : h.z};
    }
    case ShapeType::capsule:
      return {0, direction.y < 0 ? -shape.halfHeight : shape.halfHeight, 0};
    case ShapeType::hull: {
      const Hull& hull = *shape.hull;
      Vec3 best = hull.vertices[0];
      double furthest = dot(best, direction);
      for (Vec3 v : hull.vertices) {
        double along = dot(v, direction);
        if (along > furthest) furthest = along, best = v;
      }
      return best;
    }
    case ShapeType::cylinder:
    case ShapeType::cone:
      return frustumOf(shape).furthest(direction);
    case ShapeType::sphere:
    case ShapeType::plane:
    case ShapeType::mesh:
      return {};
  }
  return {};
}

// Half the extent of the shape, m, to scale tolerances. 0 for planes.
inline double coreSize(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::box:
      return length(shape.halfExtents);
    case ShapeType::capsule:
      return shape.halfHeight;
    case ShapeType::hull:
      return outerRadius(shape, shape.hull->centroid);
    case ShapeType::cylinder:
    case ShapeType::cone:
      return outerRadius(shape, {});
    case ShapeType::sphere:
    case ShapeType::plane:
    case ShapeType::mesh:
      return 0;
  }
  return 0;
}

}  // namespace brickfall
