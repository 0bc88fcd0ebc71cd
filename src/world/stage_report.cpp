// Method::report: the bodies of the world are handed to the report's system as boxes, and their motion is taken back.
#include <cmath>

#include "world/world_impl.h"

namespace brickfall {

namespace {

constexpr double kPlaneHalfSize = 200, kPlaneHalfDepth = 10;  // m: a plane as a box

// The box around all shapes, with its centre at the centre of mass.
Vec3 halfExtentsOf(const BodySet& bodies, const ShapeSet& shapes, BodyIndex body) {
  Vec3 half;
  for (ShapeIndex shape : bodies.shapes[body]) {
    const ShapeData& s = shapes.data[shape];
    Aabb box = bounds(s.geometry, s.inCentreFrame);
    half = max(half, max(abs(box.lower), abs(box.upper)));
  }
  return half;
}

ReportBody reportBodyOf(const BodySet& bodies, const ShapeSet& shapes, BodyIndex body) {
  const BodyMotion& m = bodies.motion[body];
  ShapeIndex first = bodies.shapes[body].front();
  ReportBody box;
  box.id = bodies.data[body].order;
  box.state = {m.position, m.rotation, m.linearVelocity, m.angularVelocity};
  box.mass.mass = 0;
  if (bodies.data[body].type == BodyType::dynamic) box.mass = {bodies.mass[body].mass, bodies.mass[body].inertia};
  box.friction = shapes.data[first].def.material.friction;
  box.restitution = shapes.data[first].def.material.restitution;
  box.halfExtents = halfExtentsOf(bodies, shapes, body);
  if (shapes.data[first].geometry.type == ShapeType::plane) {
    Transform plane = shapes.worldPose(first, bodies);
    box.state.rotation = plane.rotation;
    box.state.position = plane.position - rotate(plane.rotation, Vec3{0, kPlaneHalfDepth, 0});
    box.halfExtents = {kPlaneHalfSize, kPlaneHalfDepth, kPlaneHalfSize};
  }
  return box;
}

// False, and nothing changed, if the motion is not sane.
bool take(const RigidState& s, BodyMotion& m) {
  BodyMotion next = m;
  next.position = s.position;
  next.rotation = s.rotation;
  next.orientation = toMatrix(s.rotation);
  next.linearVelocity = s.velocity;
  next.angularVelocity = s.angularVelocity;
  if (!isSane(next)) return false;
  m = next;
  return true;
}

}  // namespace

void World::Impl::stepAsReported() {
  StageTimer timer(report, Stage::integrate);
  if (!reportSystem) reportSystem = std::make_unique<ReportSystem>(def.report);
  std::vector<ReportBody> boxes;
  std::vector<BodyIndex> slots;
  for (BodyIndex body : bodies.inOrder()) {
    if (bodies.data[body].quarantined || bodies.shapes[body].empty()) continue;
    boxes.push_back(reportBodyOf(bodies, shapes, body));
    slots.push_back(body);
  }
  reportSystem->step(boxes, def.gravity, context.dt);
  report.manifolds = report.touchingPoints = reportSystem->collisions();
  for (std::size_t i = 0; i < boxes.size(); i++) {
    BodyIndex body = slots[i];
    BodyMotion& m = bodies.motion[body];
    if (bodies.data[body].type == BodyType::fixed) continue;
    if (bodies.data[body].type == BodyType::kinematic) {
      m.position += m.linearVelocity * context.dt;
      bodies.setRotation(body, normalized(quatFromRotationVector(m.angularVelocity * context.dt) * m.rotation));
    } else if (!take(boxes[i].state, m)) {
      quarantine(body);
      continue;
    }
    bodies.still[body] = 0;
    keepBounds(body);
  }
  for (BodyIndex body : pendingQuarantine) isolate(body);
  pendingQuarantine.clear();
}

}  // namespace brickfall
