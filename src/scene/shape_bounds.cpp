// Bounds of shapes in the world.
#include "scene/shape_bounds.h"

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall::scene {

Aabb shapeBounds(const ShapeDef& shape, const Transform& body) {
  Transform pose = body * shape.local;
  Vec3 c = pose.position;
  Mat3 r = toMatrix(pose.rotation);
  Vec3 half;
  switch (shape.type) {
    case ShapeType::box:
      for (int i = 0; i < 3; i++) half[i] = dot(abs(r.row[i]), shape.halfExtents);
      break;
    case ShapeType::sphere:
      half = Vec3{1, 1, 1} * shape.radius;
      break;
    case ShapeType::capsule:
      half = abs(r.column(1)) * shape.halfHeight + Vec3{1, 1, 1} * shape.radius;
      break;
    case ShapeType::hull: {
      if (shape.vertices.empty()) break;
      Aabb box{transformPoint(pose, shape.vertices[0]), transformPoint(pose, shape.vertices[0])};
      for (Vec3 vertex : shape.vertices) {
        Vec3 p = transformPoint(pose, vertex);
        box = {min(box.lower, p), max(box.upper, p)};
      }
      return box;
    }
    case ShapeType::plane:
      half = Vec3{1e7, 1e7, 1e7};
      break;
    case ShapeType::mesh: {
      if (!shape.mesh) break;
      Vec3 extent = (shape.mesh->bounds().upper - shape.mesh->bounds().lower) * 0.5;
      Vec3 middle = transformPoint(pose, shape.mesh->bounds().lower + extent);
      half = abs(r.column(0)) * extent.x + abs(r.column(1)) * extent.y + abs(r.column(2)) * extent.z;
      return {middle - half, middle + half};
    }
  }
  return {c - half, c + half};
}

Aabb bodyBounds(const BodyDef& def) {
  Transform pose{def.position, normalized(def.rotation)};
  if (def.shapes.empty()) return {def.position, def.position};
  Aabb box = shapeBounds(def.shapes[0], pose);
  for (const ShapeDef& shape : def.shapes) box = merged(box, shapeBounds(shape, pose));
  return box;
}

}  // namespace brickfall::scene
