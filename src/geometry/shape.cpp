// Extents of shapes.
#include "geometry/shape.h"

#include "brickfall/geometry/mesh_tree.h"
#include "geometry/frustum.h"
#include "geometry/hull.h"

namespace brickfall {

namespace {

constexpr double kInfinite = 1e30;
constexpr double kAxisTolerance = 4e-16;  // sine of the angle up to which a plane's normal counts as a world axis

Aabb planeBounds(const Transform& pose) {
  Aabb box{{-kInfinite, -kInfinite, -kInfinite}, {kInfinite, kInfinite, kInfinite}};
  Vec3 up = rotate(pose.rotation, Vec3{0, 1, 0});
  for (int k = 0; k < 3; k++) {
    if (std::fabs(up[(k + 1) % 3]) > kAxisTolerance || std::fabs(up[(k + 2) % 3]) > kAxisTolerance) continue;
    (up[k] > 0 ? box.upper : box.lower)[k] = pose.position[k];
  }
  return box;
}

Aabb hullBounds(const std::vector<Vec3>& vertices, const Transform& pose) {
  Mat3 turn = toMatrix(pose.rotation);
  Vec3 lower = turn * vertices[0], upper = lower;
  for (Vec3 v : vertices) {
    Vec3 p = turn * v;
    lower = min(lower, p), upper = max(upper, p);
  }
  return {lower + pose.position, upper + pose.position};
}

Aabb frustumBounds(const Frustum& frustum, const Transform& pose) {
  Vec3 axis = rotate(pose.rotation, Vec3{0, 1, 0}), wide;  // extent of a circle of radius 1 across the axis
  for (int k = 0; k < 3; k++) {
    double u = axis[(k + 1) % 3], v = axis[(k + 2) % 3];
    wide[k] = std::sqrt(u * u + v * v);
  }
  Vec3 low = axis * -frustum.half, high = axis * frustum.half;
  return {min(low - wide * frustum.low, high - wide * frustum.high) + pose.position,
          max(low + wide * frustum.low, high + wide * frustum.high) + pose.position};
}

Aabb meshBounds(const Aabb& box, const Transform& pose) {
  Mat3 turn = toMatrix(pose.rotation);
  Vec3 centre = transformPoint(pose, (box.lower + box.upper) * 0.5), extent = (box.upper - box.lower) * 0.5, half;
  for (int k = 0; k < 3; k++) half[k] = dot(abs(turn.row[k]), extent);
  return {centre - half, centre + half};
}

}  // namespace

Aabb bounds(const Shape& shape, const Transform& pose) {
  Vec3 half;
  switch (shape.type) {
    case ShapeType::box: {
      Mat3 turn = toMatrix(pose.rotation);
      for (int k = 0; k < 3; k++) half[k] = dot(abs(turn.row[k]), shape.halfExtents);
      break;
    }
    case ShapeType::sphere:
      half = {shape.radius, shape.radius, shape.radius};
      break;
    case ShapeType::capsule:
      half = abs(rotate(pose.rotation, Vec3{0, shape.halfHeight, 0})) + Vec3{shape.radius, shape.radius, shape.radius};
      break;
    case ShapeType::hull:
      return hullBounds(shape.hull->vertices, pose);
    case ShapeType::plane:
      return planeBounds(pose);
    case ShapeType::mesh:
      return meshBounds(shape.mesh->bounds(), pose);
    case ShapeType::cylinder:
    case ShapeType::cone:
      return frustumBounds(frustumOf(shape), pose);
  }
  return {pose.position - half, pose.position + half};
}

Aabb bounds(const ShapeDef& shape, const Transform& body) {
  Transform pose = body * shape.local;
  bool empty =
      (shape.type == ShapeType::hull && shape.vertices.empty()) || (shape.type == ShapeType::mesh && !shape.mesh);
  if (empty) return {pose.position, pose.position};
  if (shape.type == ShapeType::hull) return hullBounds(shape.vertices, pose);
  Shape form;
  form.type = shape.type;
  form.halfExtents = shape.halfExtents;
  form.radius = shape.radius;
  form.topRadius = shape.topRadius;
  form.halfHeight = shape.halfHeight;
  form.mesh = shape.mesh.get();
  return bounds(form, pose);
}

double innerRadius(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::box: {
      Vec3 h = shape.halfExtents;
      double smaller = h.x < h.y ? h.x : h.y;
      return smaller < h.z ? smaller : h.z;
    }
    case ShapeType::sphere:
    case ShapeType::capsule:
      return shape.radius;
    case ShapeType::hull: {
      double nearest = kInfinite;
      for (const HullPlane& plane : shape.hull->planes) {
        double distance = plane.offset - dot(plane.normal, shape.hull->centroid);
        if (distance < nearest) nearest = distance;
      }
      return nearest;
    }
    case ShapeType::cylinder:
    case ShapeType::cone: {
      Frustum frustum = frustumOf(shape);
      return -footOn(frustum, {0, frustum.centre(), 0}).distance;
    }
    case ShapeType::plane:
    case ShapeType::mesh:
      break;
  }
  return kInfinite;
}

double outerRadius(const Shape& shape, Vec3 point) {
  switch (shape.type) {
    case ShapeType::box:
      return length(abs(point) + shape.halfExtents);
    case ShapeType::sphere:
      return length(point) + shape.radius;
    case ShapeType::capsule:
      return length(Vec3{point.x, std::fabs(point.y) + shape.halfHeight, point.z}) + shape.radius;
    case ShapeType::hull: {
      double furthest = 0;
      for (Vec3 v : shape.hull->vertices) {
        double distance = lengthSquared(v - point);
        if (distance > furthest) furthest = distance;
      }
      return std::sqrt(furthest);
    }
    case ShapeType::mesh: {
      double furthest = 0;
      for (Vec3 v : shape.mesh->mesh().vertices()) {
        double distance = lengthSquared(v - point);
        if (distance > furthest) furthest = distance;
      }
      return std::sqrt(furthest);
    }
    case ShapeType::cylinder:
    case ShapeType::cone: {
      Frustum frustum = frustumOf(shape);
      double across = std::sqrt(point.x * point.x + point.z * point.z), furthest = 0;
      for (int end = 0; end < 2; end++) {
        double out = across + frustum.radius(end), up = point.y - frustum.height(end);
        furthest = std::fmax(furthest, std::sqrt(out * out + up * up));
      }
      return furthest;
    }
    case ShapeType::plane:
      break;
  }
  return kInfinite;
}

}  // namespace brickfall
