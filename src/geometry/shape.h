// A shape as the engine keeps it: small, copyable, hull and mesh data held elsewhere. All but meshes are convex.
#pragma once
#include "brickfall/math.h"
#include "brickfall/shapes.h"

namespace brickfall {

struct Hull;     // geometry/hull.h
class MeshTree;  // brickfall/geometry/mesh_tree.h

struct Shape {
  ShapeType type = ShapeType::box;
  Vec3 halfExtents;                // box, m
  double radius = 0;               // sphere, capsule, cylinder, cone (at -y), m
  double topRadius = 0;            // cone (at +y), m
  double halfHeight = 0;           // capsule, cylinder, cone, m, along local y
  const Hull* hull = nullptr;      // hull; owned by the world, outlives the shape
  const MeshTree* mesh = nullptr;  // mesh; the same
};

inline Shape sphereOfRadius(double radius) {
  Shape out;
  out.type = ShapeType::sphere;
  out.radius = radius;
  return out;
}

// A core and a ball around it: its contacts wander as it moves, and are found anew in every step.
inline bool isRound(ShapeType type) {
  switch (type) {
    case ShapeType::sphere:
    case ShapeType::capsule:
      return true;
    case ShapeType::box:
    case ShapeType::hull:
    case ShapeType::plane:
    case ShapeType::mesh:
    case ShapeType::cylinder:  // some do: narrowphase/manifold.h
    case ShapeType::cone:
      return false;
  }
  return false;
}

// Bounds of the shape at a pose. A plane's bounds are infinite (+-1e30) except upwards along its own +y when that is a
// world axis.
Aabb bounds(const Shape& shape, const Transform& pose);
// Smallest distance from the shape's centroid to its surface, m; sets margins and torque scales. A plane or mesh: 1e30.
double innerRadius(const Shape& shape);
// Largest distance of a point of the shape from `point` (shape frame), m. A plane: 1e30.
double outerRadius(const Shape& shape, Vec3 point);

}  // namespace brickfall
