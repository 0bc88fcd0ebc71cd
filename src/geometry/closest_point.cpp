// The point of a solid nearest to a given one.
#include "brickfall/geometry/mesh_tree.h"
#include "geometry/frustum.h"
#include "geometry/hull.h"
#include "geometry/queries.h"

namespace brickfall {

namespace {

double clamped(double value, double limit) { return value < -limit ? -limit : value > limit ? limit : value; }

Vec3 ontoBall(Vec3 centre, double radius, Vec3 point) {
  Vec3 offset = point - centre;
  double distance = length(offset);
  return distance <= radius ? point : centre + offset * (radius / distance);
}

// Nearest point of one face to a point above it: its foot if that is in the polygon, else the best of the edges.
Vec3 ontoFace(const Hull& hull, std::size_t face, Vec3 point, double height) {
  Vec3 normal = hull.planes[face].normal, best;
  double nearest = -1;
  bool within = true;
  std::uint16_t start = hull.firstEdge[face], e = start;
  do {
    Vec3 a = hull.vertices[hull.edges[e].origin];
    e = hull.edges[e].next;
    Vec3 along = hull.vertices[hull.edges[e].origin] - a;
    if (dot(cross(normal, along), point - a) >= 0) continue;
    within = false;
    double t = dot(point - a, along) / lengthSquared(along);
    Vec3 candidate = a + along * (t < 0 ? 0 : t > 1 ? 1 : t);
    double distance = lengthSquared(point - candidate);
    if (nearest < 0 || distance < nearest) nearest = distance, best = candidate;
  } while (e != start);
  return within ? point - normal * height : best;
}

// The nearest point lies on a face that the point is above.
Vec3 ontoHull(const Hull& hull, Vec3 point) {
  Vec3 best = point;
  double nearest = -1;
  for (std::size_t face = 0; face < hull.planes.size(); face++) {
    double height = dot(hull.planes[face].normal, point) - hull.planes[face].offset;
    if (!(height > 0)) continue;
    Vec3 candidate = ontoFace(hull, face, point, height);
    double distance = lengthSquared(point - candidate);
    if (nearest < 0 || distance < nearest) nearest = distance, best = candidate;
  }
  return best;
}

}  // namespace

Vec3 closestPoint(const Shape& shape, Vec3 point) {
  switch (shape.type) {
    case ShapeType::box: {
      Vec3 h = shape.halfExtents;
      return {clamped(point.x, h.x), clamped(point.y, h.y), clamped(point.z, h.z)};
    }
    case ShapeType::sphere:
      return ontoBall({}, shape.radius, point);
    case ShapeType::capsule:
      return ontoBall({0, clamped(point.y, shape.halfHeight), 0}, shape.radius, point);
    case ShapeType::hull:
      return ontoHull(*shape.hull, point);
    case ShapeType::plane:
      return {point.x, point.y < 0 ? point.y : 0, point.z};
    case ShapeType::cylinder:
    case ShapeType::cone: {
      FrustumFoot foot = footOn(frustumOf(shape), point);
      return foot.distance > 0 ? foot.point : point;
    }
    case ShapeType::mesh:
      return shape.mesh->closestPoint(point, 1e300)->point;
  }
  return point;
}

}  // namespace brickfall
