// Queries of a world with a ray, or with a whole shape.
#include <algorithm>
#include <cmath>

#include "geometry/queries.h"
#include "world/checks.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

// tell(hit, limit) of shapes that a ray meets up to `limit` m from its origin, in any order; it returns the next limit.
template <class Tell>
Status eachHit(const Proximity& proximity, const Registry& registry, Vec3 origin, Vec3 direction, double maxDistance,
               std::uint32_t mask, Tell&& tell) {
  Checks check;
  check.vector("origin", origin, limits::kLargestReach);
  const double largest = std::max({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)});
  check.condition(isFinite(direction) && largest > 1e-12, "direction: found zero or not finite, expected a direction");
  check.range("maxDistance", maxDistance, 0, limits::kLargestReach);
  if (check.failed()) return check.error();
  direction = normalized(direction * (1 / largest));  // first to about one: its square must not overflow
  proximity.broadPhase->queryRay(origin, direction, maxDistance, [&](std::uint32_t shape, double limit) {
    const ShapeData& s = registry.shapes.data[shape];
    if (!s.answers(mask)) return limit;
    const Transform pose = registry.shapes.worldPose(shape, registry.bodies), back = inverse(pose);
    const auto hit = castRay(s.geometry, transformPoint(back, origin), rotate(back.rotation, direction), limit);
    if (!hit) return limit;
    return tell(RayHit{registry.idOf(s.body), registry.idOfShape(shape), transformPoint(pose, hit->point),
                       rotate(pose.rotation, hit->normal), hit->distance},
                limit);
  });
  return {};
}

bool isNearer(const RayHit& a, const RayHit& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.shape < b.shape;
}

// A shape that asks: its geometry, and where it is.
struct Asking {
  Shape shape;
  std::unique_ptr<Hull> hull;
  Transform pose;
};

Result<Asking> askingWith(const ShapeDef& def, const Transform& body) {
  Checks check;
  check.condition(def.type != ShapeType::plane && def.type != ShapeType::mesh,
                  "shape.type: found a plane or a mesh, expected a shape that encloses a volume");
  ShapeDef own = def;
  own.distribution = nullptr;
  if (!check.failed()) checkShape(check, "shape", own, BodyType::dynamic);
  check.vector("pose.position", body.position, limits::kLargestReach);
  check.rotation("pose.rotation", body.rotation);
  if (check.failed()) return check.error();
  Result<std::unique_ptr<Hull>> hull = hullOf(def);
  if (!hull) return Error{hull.error().code, "shape.vertices: " + hull.error().message};
  Asking out;
  out.hull = std::move(hull).value();
  out.shape = geometryOf(def, out.hull.get());
  out.pose = Transform{body.position, normalized(body.rotation)} *
             Transform{def.local.position, normalized(def.local.rotation)};
  return out;
}

// Where a shape that goes by `way` meets another, in the frame of that.
struct Touch {
  Vec3 point, normal;
};

// Two that touch have no normal. A little before they do.
Touch touchOf(const Shape& other, const Shape& shape, const Transform& placed, Vec3 way, double share) {
  const double size = std::min(innerRadius(shape), length(way));
  const Vec3 direction = normalized(way);
  for (double back : {0.0, 1e-6, 1e-4, 1e-2}) {
    const DistanceResult met =
        shapeDistance(other, shape, {placed.position + way * share - direction * (back * size), placed.rotation});
    const Vec3 apart = met.onB - met.onA;
    if (met.distance > 0 && dot(apart, direction) < 0) return {met.onA, normalized(apart)};
  }
  return {placed.position + way * share, -direction};
}

}  // namespace

Result<std::optional<RayHit>> World::castRay(Vec3 origin, Vec3 direction, double maxDistance,
                                             std::uint32_t mask) const {
  std::optional<RayHit> best;
  const Status fine = eachHit(impl_->proximity, impl_->registry, origin, direction, maxDistance, mask,
                              [&](const RayHit& hit, double limit) {
                                if (best && !isNearer(hit, *best)) return limit;
                                best = hit;
                                return hit.distance;
                              });
  if (!fine) return fine.error();
  return best;
}

Result<std::vector<RayHit>> World::castRayAll(Vec3 origin, Vec3 direction, double maxDistance,
                                              std::uint32_t mask) const {
  std::vector<RayHit> hits;
  const Status fine = eachHit(impl_->proximity, impl_->registry, origin, direction, maxDistance, mask,
                              [&](const RayHit& hit, double limit) {
                                hits.push_back(hit);
                                return limit;
                              });
  if (!fine) return fine.error();
  std::sort(hits.begin(), hits.end(), isNearer);
  return hits;
}

Result<std::vector<ShapeId>> World::overlapShape(const ShapeDef& shape, const Transform& pose,
                                                 std::uint32_t mask) const {
  const Impl& w = *impl_;
  const Result<Asking> asking = askingWith(shape, pose);
  if (!asking) return asking.error();
  const Transform back = inverse(asking->pose);
  std::vector<ShapeId> found;
  w.proximity.broadPhase->query(bounds(asking->shape, asking->pose), [&](std::uint32_t other) {
    const ShapeData& s = w.registry.shapes.data[other];
    if (!s.answers(mask)) return true;
    const Transform placed = back * w.registry.shapes.worldPose(other, w.registry.bodies);
    if (penetrationDepth(asking->shape, s.geometry, placed) > 0) found.push_back(w.registry.idOfShape(other));
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

Result<std::optional<ShapeCastHit>> World::castShape(const ShapeDef& shape, const Transform& from, Vec3 motion,
                                                     std::uint32_t mask) const {
  const Impl& w = *impl_;
  const Result<Asking> asking = askingWith(shape, from);
  if (!asking) return asking.error();
  Checks check;
  check.vector("motion", motion, limits::kLargestReach);
  if (check.failed()) return check.error();
  const Aabb start = bounds(asking->shape, asking->pose);
  const Aabb swept = merged(start, {start.lower + motion, start.upper + motion});
  std::optional<ShapeCastHit> best;
  w.proximity.broadPhase->query(swept, [&](std::uint32_t other) {
    const ShapeData& s = w.registry.shapes.data[other];
    if (!s.answers(mask)) return true;
    const Transform pose = w.registry.shapes.worldPose(other, w.registry.bodies), back = inverse(pose);
    const Transform placed = back * asking->pose;
    const Vec3 way = rotate(back.rotation, motion);
    std::optional<double> share = 0.0;
    const bool within = penetrationDepth(s.geometry, asking->shape, placed) > 0;
    if (!within) share = timeOfImpact(s.geometry, asking->shape, placed, way, 0);
    const ShapeId id = w.registry.idOfShape(other);
    if (!share || (best && (*share > best->share || (*share == best->share && best->shape < id)))) return true;
    ShapeCastHit hit{w.registry.idOf(s.body), id, asking->pose.position + motion * *share, {}, *share};
    if (!within) {
      const Touch touch = touchOf(s.geometry, asking->shape, placed, way, *share);
      hit.pointWorld = transformPoint(pose, touch.point);
      hit.normalWorld = rotate(pose.rotation, touch.normal);
    }
    best = hit;
    return true;
  });
  return best;
}

}  // namespace brickfall
