#include "viewer_core/shape_facts.h"

#include <algorithm>

namespace brickfall::viewer {

double radiusOf(const std::vector<ShapeDef>& shapes) {
  double radius = 0;
  for (const ShapeDef& shape : shapes) {
    if (shape.type == ShapeType::plane) continue;
    const Aabb box = bounds(shape, Transform{});
    radius = std::max(radius, length(max(abs(box.lower), abs(box.upper))));
  }
  return radius;
}

double topOf(const std::vector<ShapeDef>& shapes, const Transform& body) {
  double top = kNoGround;
  for (const ShapeDef& shape : shapes) {
    const Transform pose = body * shape.local;
    if (shape.type == ShapeType::plane && rotate(pose.rotation, Vec3{0, 1, 0}).y > 0.99)
      top = std::max(top, pose.position.y);
    if (shape.type == ShapeType::box) top = std::max(top, bounds(shape, body).upper.y);
  }
  return top;
}

}  // namespace brickfall::viewer
