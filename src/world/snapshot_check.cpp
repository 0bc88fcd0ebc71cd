// After a snapshot's fields are read: are they a world? Everything that the rest determines is worked out anew. The
// rest is checked as the API checks its arguments. World::restore then asks validate() for every invariant.
#include <cmath>

#include "dynamics/tie_ranges.h"
#include "world/checks.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

using ties::hasUnitLength;
using ties::isNear;
using ties::kFarthest;

//! not of the method: what a snapshot may say
constexpr double kLargestBounds = 2e30;  // m: those of a plane are 1e30

void checkBody(Checks& check, const BodyData& d, const BodyMotion& m) {
  checkMotionSettings(check, d.gravityScale, d.linearDamping, d.angularDamping, d.dragArea);
  check.vector("surfaceVelocity", d.surfaceVelocity, limits::kLargestSpeed);
  check.condition(isNear(m.position, kFarthest), "a body is not in the world");
  check.condition(hasUnitLength(m.rotation), "a body's quaternion is not of unit length");
  check.condition(isFinite(m.linearVelocity) && isFinite(m.angularVelocity), "a body's motion is not finite");
  // A dynamic body that is too fast is quarantined by the next step.
  check.condition(
      d.type == BodyType::dynamic || (isNear(m.linearVelocity, kFarthest) && isNear(m.angularVelocity, kFarthest)),
      "a body moves too fast");
  check.condition(isFinite(d.force) && isFinite(d.torque) && isFinite(d.lastLinearVelocity) &&
                      isFinite(d.lastAngularVelocity) && isFinite(d.linearAcceleration) &&
                      isFinite(d.angularAcceleration) && !std::isnan(d.turnEnergy),
                  "a body's forces or accelerations are not finite");
  check.condition(isNear(d.steady.linear, kFarthest) && isNear(d.steady.angular, kFarthest) && d.steady.dt >= 0 &&
                      d.steady.dt <= 1 && d.usualChange >= 0 && std::isfinite(d.usualChange) && d.impactLoss >= 0 &&
                      std::isfinite(d.impactLoss),
                  "what a body remembers of its last step is out of range");
}

void checkShapeData(Checks& check, const ShapeData& s, const Aabb& b, BodyType type) {
  checkShape(check, "shape", s.def, type);
  check.condition(hasUnitLength(s.def.local.rotation), "a shape's quaternion is not of unit length");
  bool bounds = isNear(b.lower, kLargestBounds) && isNear(b.upper, kLargestBounds) && b.lower.x <= b.upper.x &&
                b.lower.y <= b.upper.y && b.lower.z <= b.upper.z;
  check.condition(bounds, "a shape's bounds are not sound");
}

void checkIsland(Checks& check, Findings& ranges, const Island& island) {
  for (const Transform& pose : island.placePoses)
    check.condition(isFinite(pose.position) && isFinite(pose.rotation), "an island's place is not finite");
  island.rows.eachKind([&](const auto& kind) { kind.checkRanges(ranges); });
}

}  // namespace

Status World::Impl::rebuild() {
  if (Status fine = checkWorld(def); !fine) return fine;
  proximity.open(def.broadPhase, def.solver.contactMargin);
  BodySet& bodies = registry.bodies;
  ShapeSet& shapes = registry.shapes;
  for (const BodyData& d : bodies.data) registry.dynamicBodies += d.alive && d.type == BodyType::dynamic;
  Findings structure;
  checkStructure(structure);
  if (structure.any()) return Error{ErrorCode::badFormat, structure.take().front()};
  Checks check;
  for (BodyIndex i = 0; i < bodies.slots(); i++) {
    if (!bodies.alive(i)) continue;
    checkBody(check, bodies.data[i], bodies.motion[i]);
    if (bodies.data[i].givenMass) {
      std::vector<ShapeDef> own;
      for (ShapeIndex s : bodies.shapes[i]) own.push_back(shapes.data[s].def);
      if (!check.failed()) checkGivenMass(check, *bodies.data[i].givenMass, own);
    }
    for (ShapeIndex s : bodies.shapes[i])
      checkShapeData(check, shapes.data[s], proximity.around[s].swept, bodies.data[i].type);
  }
  if (check.failed()) return check.error();
  if (Status built = registry.rebuild(); !built) return built;
  for (BodyIndex i = 0; i < bodies.slots(); i++)
    // A platform of triangles may have no mass.
    if (bodies.alive(i) && bodies.data[i].type == BodyType::dynamic)
      checkMass(check, bodies.data[i].bodyFrameMass.mass);
  Findings ranges;
  ties.checkRanges(ranges);
  for (const auto* list : {&activity.islands.awake, &activity.islands.asleep})
    for (const auto& island : *list) checkIsland(check, ranges, *island);
  if (ranges.any()) check.take({ErrorCode::invalidArgument, ranges.take().front()});
  if (check.failed()) return check.error();
  Findings links;
  checkLinks(links);
  if (links.any()) return Error{ErrorCode::badFormat, links.take().front()};
  for (ShapeIndex i = 0; i < shapes.slots(); i++) {
    const ShapeData& s = shapes.data[i];
    if (!s.alive || !bodies.takesPart(s.body)) continue;
    // A hit may have thrown the body out of the bounds swept before it.
    Aabb now = bounds(s.geometry, shapes.worldPose(i, bodies));
    proximity.enter(registry, i, merged(now, proximity.around[i].swept));
  }
  for (ContactEvent& event : diary.pending.end) {
    event.bodyA.world = event.bodyB.world = registry.worldNumber;
    event.shapeA.world = event.shapeB.world = registry.worldNumber;
  }
  for (BodyId& body : diary.pending.woke) body.world = registry.worldNumber;
  for (MortarEvent& event : diary.pending.mortar) {
    if (!isNear(event.pointWorld, kFarthest) || !(std::fabs(event.energy) <= ties::kLargestMemory))
      return Error{ErrorCode::badFormat, "events: mortar that was dropped is out of range"};
    event.bodyA.world = event.bodyB.world = event.mortar.world = registry.worldNumber;
  }
  for (SensorEvent& event : diary.sensed)
    event.sensor.world = event.shape.world = event.sensorBody.world = event.body.world = registry.worldNumber;
  return {};
}

}  // namespace brickfall
