// Queries of a world between steps.
#include <algorithm>

#include "base/hash.h"
#include "geometry/queries.h"
#include "world/checks.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

// Bodies of which a shape fulfils `touches`, in order of their slots, each once.
template <class Touches>
std::vector<BodyId> bodiesNear(const Proximity& proximity, const Registry& registry, const Aabb& box,
                               std::uint32_t mask, Touches touches) {
  std::vector<BodyIndex> found;
  proximity.broadPhase->query(box, [&](std::uint32_t shape) {
    const ShapeData& s = registry.shapes.data[shape];
    if (s.answers(mask) && touches(s, registry.shapes.worldPose(shape, registry.bodies))) found.push_back(s.body);
    return true;
  });
  makeAscending(found);
  std::vector<BodyId> out;
  for (BodyIndex body : found) out.push_back(registry.idOf(body));
  return out;
}

// In sums over the world.
template <class Visit> void eachThatCounts(const BodySet& bodies, Visit visit) {
  for (BodyIndex i = 0; i < bodies.slots(); i++)
    if (bodies.alive(i) && bodies.data[i].type == BodyType::dynamic && bodies.data[i].enabled) visit(i);
}

}  // namespace

Result<std::vector<BodyId>> World::overlapBox(const Aabb& box, std::uint32_t mask) const {
  const Impl& w = *impl_;
  Checks check;
  check.vector("box.lower", box.lower, limits::kLargestReach);
  check.vector("box.upper", box.upper, limits::kLargestReach);
  check.range("box.lower.x", box.lower.x, -limits::kLargestReach, box.upper.x);
  check.range("box.lower.y", box.lower.y, -limits::kLargestReach, box.upper.y);
  check.range("box.lower.z", box.lower.z, -limits::kLargestReach, box.upper.z);
  if (check.failed()) return check.error();
  Shape region;
  region.halfExtents = max((box.upper - box.lower) * 0.5, Vec3{1e-9, 1e-9, 1e-9});
  Transform pose{(box.lower + box.upper) * 0.5, {}};
  return bodiesNear(w.proximity, w.registry, box, mask, [&](const ShapeData& s, const Transform& at) {
    return penetrationDepth(region, s.geometry, inverse(pose) * at) > 0;
  });
}

Result<std::vector<BodyId>> World::overlapSphere(Vec3 centre, double radius, std::uint32_t mask) const {
  const Impl& w = *impl_;
  Checks check;
  check.vector("centre", centre, limits::kLargestReach);
  check.range("radius", radius, 0, limits::kLargestReach);
  if (check.failed()) return check.error();
  const Aabb box = grown({centre, centre}, radius);
  return bodiesNear(w.proximity, w.registry, box, mask, [&](const ShapeData& s, const Transform& at) {
    const Vec3 local = transformPoint(inverse(at), centre);
    return lengthSquared(closestPoint(s.geometry, local) - local) <= radius * radius;
  });
}

Result<std::optional<ClosestResult>> World::closest(Vec3 point, double maxDistance, std::uint32_t mask) const {
  const Impl& w = *impl_;
  Checks check;
  check.vector("point", point, limits::kLargestReach);
  check.range("maxDistance", maxDistance, 0, limits::kLargestReach);
  if (check.failed()) return check.error();
  std::optional<ClosestResult> best;
  w.proximity.broadPhase->query(grown({point, point}, maxDistance), [&](std::uint32_t shape) {
    const ShapeData& s = w.registry.shapes.data[shape];
    if (!s.answers(mask)) return true;
    Transform pose = w.registry.shapes.worldPose(shape, w.registry.bodies);
    const Vec3 local = transformPoint(inverse(pose), point), closest = closestPoint(s.geometry, local);
    // There and back again a point inside would be 1e-16 m off.
    const Vec3 near = closest == local ? point : transformPoint(pose, closest);
    double distance = length(near - point);
    if (!(distance <= maxDistance)) return true;
    ShapeId id = w.registry.idOfShape(shape);
    if (!best || distance < best->distance || (distance == best->distance && id < best->shape))
      best = ClosestResult{w.registry.idOf(s.body), id, near, distance};
    return true;
  });
  return best;
}

void World::forEachContact(const std::function<void(const ContactView&)>& visit) const {
  const Impl& w = *impl_;
  if (!visit) return;
  Visit here(w.visiting);
  auto show = [&](const CandidatePair& pair) {
    if (pair.contact == kNoIndex) return;
    const Contact& c = w.ties.contacts.contacts[pair.contact];
    const ContactGeometry& g = w.ties.contacts.geometry[pair.contact];
    const BodyMotion& a = w.registry.bodies.motion[c.bodyA];
    ContactView view;
    view.bodyA = w.registry.idOf(c.bodyA);
    view.bodyB = w.registry.idOf(c.bodyB);
    view.shapeA = w.registry.idOfShape(c.shapeA);
    view.shapeB = w.registry.idOfShape(c.shapeB);
    Vec3 n = a.orientation * g.normal, t1 = a.orientation * g.tangent1, t2 = cross(n, t1);
    Vec3 centre = a.position + a.orientation * g.centre;
    view.normalWorld = n;
    view.pointCount = c.count;
    for (int i = 0; i < c.count; i++) {
      ContactPointView& p = view.points[i];
      p.pointWorld = centre + t1 * double(c.points.s1[i]) + t2 * double(c.points.s2[i]);
      p.separation = c.points.gap[i];
      p.normalForce = c.points.forceN[i] + c.points.hitN[i];
      p.frictionForce =
          t1 * double(c.points.force1[i] + c.points.hit1[i]) + t2 * double(c.points.force2[i] + c.points.hit2[i]);
    }
    visit(view);
  };
  std::size_t i = 0, j = 0;
  const auto &p = w.ties.contacts.pairs, &q = w.ties.contacts.asleep;
  while (i < p.size() || j < q.size()) show(j == q.size() || (i < p.size() && p[i] < q[j]) ? p[i++] : q[j++]);
}

void World::forEachIsland(const std::function<void(const IslandView&)>& visit) const {
  const Impl& w = *impl_;
  if (!visit) return;
  Visit here(w.visiting);
  std::vector<BodyId> ids;
  const auto show = [&](const Island& island, bool awake) {
    ids.clear();
    for (BodyIndex body : island.bodies) ids.push_back(w.registry.idOf(body));
    visit({ids, awake, island.ending});
  };
  for (const auto& island : w.activity.islands.awake) show(*island, true);
  // The world keeps these in the order in which they fell asleep.
  std::vector<const Island*> asleep;
  for (const auto& island : w.activity.islands.asleep) asleep.push_back(island.get());
  std::sort(asleep.begin(), asleep.end(), [](const Island* a, const Island* b) { return a->key() < b->key(); });
  for (const Island* island : asleep) show(*island, false);
}

Result<double> World::penetration(ShapeId a, ShapeId b) const {
  const Impl& w = *impl_;
  Result<ShapeIndex> shapeA = w.registry.find(a);
  if (!shapeA) return shapeA.error();
  Result<ShapeIndex> shapeB = w.registry.find(b);
  if (!shapeB) return shapeB.error();
  Transform bInA = inverse(w.registry.shapes.worldPose(*shapeA, w.registry.bodies)) *
                   w.registry.shapes.worldPose(*shapeB, w.registry.bodies);
  return penetrationDepth(w.registry.shapes.data[*shapeA].geometry, w.registry.shapes.data[*shapeB].geometry, bInA);
}

Energy World::energy() const {
  const BodySet& bodies = impl_->registry.bodies;
  Energy e;
  eachThatCounts(bodies, [&](BodyIndex i) {
    e.kinetic += bodies.kineticEnergy(i);
    e.potential -=
        bodies.mass[i].mass * bodies.data[i].gravityScale * dot(impl_->def.gravity, bodies.motion[i].position);
  });
  return e;
}

Vec3 World::linearMomentum() const {
  const BodySet& bodies = impl_->registry.bodies;
  Vec3 sum;
  eachThatCounts(bodies, [&](BodyIndex i) { sum += bodies.motion[i].linearVelocity * bodies.mass[i].mass; });
  return sum;
}

Vec3 World::angularMomentum() const {
  const BodySet& bodies = impl_->registry.bodies;
  Vec3 sum;
  eachThatCounts(bodies, [&](BodyIndex i) {
    const BodyMotion& m = bodies.motion[i];
    sum += cross(m.position, m.linearVelocity * bodies.mass[i].mass) + bodies.worldInertia(i) * m.angularVelocity;
  });
  return sum;
}

std::uint64_t World::stateHash() const {
  const Impl& w = *impl_;
  Hash hash;
  auto add = [&](Vec3 v) {
    hash.add(v.x);
    hash.add(v.y);
    hash.add(v.z);
  };
  for (BodyIndex body : w.registry.bodies.inOrder()) {
    const BodyMotion& m = w.registry.bodies.motion[body];
    add(m.position);
    add({m.rotation.x, m.rotation.y, m.rotation.z});
    hash.add(m.rotation.w);
    add(m.linearVelocity);
    add(m.angularVelocity);
  }
  return hash.value();
}

}  // namespace brickfall
