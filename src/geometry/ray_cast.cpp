// Rays against single shapes. A solid is met where the ray enters it; a ray that starts inside hits at once.
#include "brickfall/geometry/mesh_tree.h"
#include "geometry/frustum.h"
#include "geometry/hull.h"
#include "geometry/queries.h"

namespace brickfall {

namespace {

// The part of the ray inside a set of half spaces, with the plane through which it comes in.
struct RayInterval {
  double enter = 0, exit = 0;
  Vec3 normal;
  bool inside = true;  // the origin is in all half spaces so far
  bool empty = false;

  // Half space: height above its plane at the origin, and the change of height per metre of ray.
  void clip(Vec3 planeNormal, double height, double slope) {
    if (height > 0) {
      inside = false;
      if (!(slope < 0)) {
        empty = true;
      } else if (double t = height / -slope; t > enter || normal == Vec3{}) {
        enter = t, normal = planeNormal;
      }
    } else if (slope > 0) {
      double t = -height / slope;
      if (t < exit) exit = t;
    }
  }
};

std::optional<ShapeRayHit> hitOf(const RayInterval& interval, Vec3 origin, Vec3 direction) {
  if (interval.empty || interval.enter > interval.exit) return {};
  if (interval.inside) return ShapeRayHit{origin, -direction, 0};
  return ShapeRayHit{origin + direction * interval.enter, interval.normal, interval.enter};
}

std::optional<ShapeRayHit> castBox(Vec3 half, Vec3 origin, Vec3 direction, double maxDistance) {
  RayInterval interval{0, maxDistance};
  for (int k = 0; k < 3; k++) {
    Vec3 axis;
    axis[k] = 1;
    interval.clip(axis, origin[k] - half[k], direction[k]);
    interval.clip(-axis, -origin[k] - half[k], -direction[k]);
  }
  return hitOf(interval, origin, direction);
}

std::optional<ShapeRayHit> castHull(const Hull& hull, Vec3 origin, Vec3 direction, double maxDistance) {
  RayInterval interval{0, maxDistance};
  for (const HullPlane& plane : hull.planes) {
    interval.clip(plane.normal, dot(plane.normal, origin) - plane.offset, dot(plane.normal, direction));
  }
  return hitOf(interval, origin, direction);
}

// Measured from the point of the ray nearest to the centre, so that a far origin costs no precision.
std::optional<ShapeRayHit> castSphere(Vec3 centre, double radius, Vec3 origin, Vec3 direction, double maxDistance) {
  Vec3 o = origin - centre;
  double middle = -dot(o, direction);
  Vec3 nearest = o + direction * middle;
  double left = radius * radius - lengthSquared(nearest);
  if (!(left >= 0)) return {};
  double distance = middle - std::sqrt(left);
  if (!(distance >= 0 && distance <= maxDistance)) return {};
  Vec3 normal = normalized(nearest - direction * std::sqrt(left));
  return ShapeRayHit{centre + normal * radius, normal, distance};
}

// The round side as a circle in the plane y = 0, then the two caps as spheres.
std::optional<ShapeRayHit> castCapsule(double radius, double halfHeight, Vec3 origin, Vec3 direction,
                                       double maxDistance) {
  Vec3 across{direction.x, 0, direction.z}, o{origin.x, 0, origin.z};
  double speed = length(across);
  if (speed > 0) {
    if (auto side = castSphere({}, radius, o, across * (1 / speed), maxDistance * speed)) {
      double distance = side->distance / speed, y = origin.y + direction.y * distance;
      if (std::fabs(y) <= halfHeight) return ShapeRayHit{{side->point.x, y, side->point.z}, side->normal, distance};
    }
  }
  auto top = castSphere({0, halfHeight, 0}, radius, origin, direction, maxDistance);
  auto bottom = castSphere({0, -halfHeight, 0}, radius, origin, direction, maxDistance);
  if (top && bottom) return top->distance <= bottom->distance ? top : bottom;
  return top ? top : bottom;
}

// The two caps as discs, then the side: where the distance from the axis is what the height asks for. Measured from the point
// of the ray nearest to the middle, so that a far origin costs no precision.
std::optional<ShapeRayHit> castFrustum(const Frustum& f, Vec3 origin, Vec3 direction, double maxDistance) {
  std::optional<ShapeRayHit> best;
  const double middle = -dot(origin, direction);
  const Vec3 o = origin + direction * middle, d = direction;
  auto offer = [&](double t, Vec3 point, Vec3 normal) {
    const double distance = middle + t;
    if (!(distance >= 0 && distance <= maxDistance) || !(dot(normal, d) < 0)) return;
    if (!best || distance < best->distance) best = ShapeRayHit{point, normal, distance};
  };
  for (int end = 0; end < 2; end++) {
    const double t = (f.height(end) - o.y) / d.y;
    const Vec3 p{o.x + d.x * t, f.height(end), o.z + d.z * t};
    if (p.x * p.x + p.z * p.z <= f.radius(end) * f.radius(end)) offer(t, p, {0, end == 0 ? -1.0 : 1.0, 0});
  }
  const double slope = 0.5 * (f.high - f.low) / f.half, radius = f.radiusAt(o.y);
  const double a = d.x * d.x + d.z * d.z - slope * slope * d.y * d.y;
  const double b = o.x * d.x + o.z * d.z - slope * d.y * radius, c = o.x * o.x + o.z * o.z - radius * radius;
  const double left = b * b - a * c;
  if (!(left >= 0)) return best;
  const double q = b > 0 ? -b - std::sqrt(left) : -b + std::sqrt(left);
  double out, up;
  f.sideNormal(out, up);
  for (double t : {q / a, c / q}) {
    const Vec3 p = o + d * t;
    const double at = std::sqrt(p.x * p.x + p.z * p.z);
    if (std::fabs(p.y) <= f.half && at > 0) offer(t, p, {p.x / at * out, up, p.z / at * out});
  }
  return best;
}

}  // namespace

std::optional<ShapeRayHit> castRay(const Shape& shape, Vec3 origin, Vec3 direction, double maxDistance) {
  if (!(maxDistance >= 0)) return {};
  ShapeRayHit inside{origin, -direction, 0};
  switch (shape.type) {
    case ShapeType::box:
      return castBox(shape.halfExtents, origin, direction, maxDistance);
    case ShapeType::hull:
      return castHull(*shape.hull, origin, direction, maxDistance);
    case ShapeType::sphere:
      if (lengthSquared(origin) <= shape.radius * shape.radius) return inside;
      return castSphere({}, shape.radius, origin, direction, maxDistance);
    case ShapeType::capsule: {
      double y = origin.y < -shape.halfHeight  ? -shape.halfHeight
                 : origin.y > shape.halfHeight ? shape.halfHeight
                                               : origin.y;
      if (lengthSquared(origin - Vec3{0, y, 0}) <= shape.radius * shape.radius) return inside;
      return castCapsule(shape.radius, shape.halfHeight, origin, direction, maxDistance);
    }
    case ShapeType::cylinder:
    case ShapeType::cone:
      if (!(footOn(frustumOf(shape), origin).distance > 0)) return inside;
      return castFrustum(frustumOf(shape), origin, direction, maxDistance);
    case ShapeType::plane: {
      if (origin.y <= 0) return inside;
      double distance = origin.y / -direction.y;
      if (!(direction.y < 0 && distance <= maxDistance)) return {};
      return ShapeRayHit{
          {origin.x + direction.x * distance, 0, origin.z + direction.z * distance}, {0, 1, 0}, distance};
    }
    case ShapeType::mesh: {
      auto hit = shape.mesh->castRay(origin, direction, maxDistance);
      if (!hit) return {};
      return ShapeRayHit{hit->point, hit->normal, hit->distance};
    }
  }
  return {};
}

}  // namespace brickfall
