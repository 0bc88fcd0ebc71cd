// Shapes as the world keeps them, without a world.
#pragma once
#include "dynamics/shape_set.h"

namespace brickfall::test {

inline ShapeData shapeOf(const Shape& geometry) {
  ShapeData s;
  s.geometry = geometry;
  s.innerRadius = innerRadius(geometry);
  return s;
}
inline ShapeData boxShape(Vec3 halfExtents) { return shapeOf({.type = ShapeType::box, .halfExtents = halfExtents}); }
inline ShapeData ballShape(double radius) { return shapeOf({.type = ShapeType::sphere, .radius = radius}); }
inline ShapeData capsuleShape(double radius, double halfHeight) {
  return shapeOf({.type = ShapeType::capsule, .radius = radius, .halfHeight = halfHeight});
}

}  // namespace brickfall::test
