// Shapes as the world keeps them, without a world.
#pragma once
#include "dynamics/shape_set.h"

namespace brickfall::test {

inline ShapeData boxShape(Vec3 halfExtents) {
  ShapeData s;
  s.geometry.type = ShapeType::box;
  s.geometry.halfExtents = halfExtents;
  s.innerRadius = innerRadius(s.geometry);
  return s;
}
inline ShapeData ballShape(double radius) {
  ShapeData s;
  s.geometry.type = ShapeType::sphere;
  s.geometry.radius = radius;
  s.innerRadius = innerRadius(s.geometry);
  return s;
}
inline ShapeData capsuleShape(double radius, double halfHeight) {
  ShapeData s = ballShape(radius);
  s.geometry.type = ShapeType::capsule;
  s.geometry.halfHeight = halfHeight;
  return s;
}

}  // namespace brickfall::test
