// The usual bodies in one line: a definition that may be changed before World::createBody takes it.
#pragma once
#include "brickfall/body.h"

namespace brickfall {

// A dynamic box of `size` m (length, height, width), in the middle of its frame.
inline BodyDef boxBody(Vec3 size, const Material& material = {}, Vec3 position = {}) {
  BodyDef def;
  ShapeDef shape;
  shape.halfExtents = size * 0.5;
  shape.material = material;
  def.shapes.push_back(shape);
  def.position = position;
  return def;
}

// A dynamic ball of `radius` m.
inline BodyDef ballBody(double radius, const Material& material = {}, Vec3 position = {}) {
  BodyDef def;
  ShapeDef shape;
  shape.type = ShapeType::sphere;
  shape.radius = radius;
  shape.material = material;
  def.shapes.push_back(shape);
  def.position = position;
  return def;
}

// A fixed plane without end: all below `height` m is solid.
inline BodyDef groundPlane(double height = 0, const Material& material = {}) {
  BodyDef def;
  def.type = BodyType::fixed;
  ShapeDef shape;
  shape.type = ShapeType::plane;
  shape.material = material;
  def.shapes.push_back(shape);
  def.position = {0, height, 0};
  return def;
}

}  // namespace brickfall
