// Debug drawing through callbacks.
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! not of the method: drawing
constexpr std::uint32_t kFixedColour = 0x808080, kAwakeColour = 0xD08050, kAsleepColour = 0x5070A0,
                        kQuarantineColour = 0xFF00FF, kVelocityColour = 0x40C040, kJointColour = 0xE0C040,
                        kSurfaceColour = 0x40B0E0;

std::uint32_t colourOf(const BodyData& data) {
  if (data.quarantined) return kQuarantineColour;
  if (data.type != BodyType::dynamic) return kFixedColour;
  return data.activity == BodyActivity::asleep ? kAsleepColour : kAwakeColour;
}

}  // namespace

void World::draw(const DebugDraw& draw) const {
  const Impl& w = *impl_;
  Visit here(w.visiting);
  for (BodyIndex body : w.registry.bodies.inOrder()) {
    const BodyMotion& m = w.registry.bodies.motion[body];
    for (ShapeIndex shape : w.registry.bodies.shapes[body]) {
      const ShapeData& s = w.registry.shapes.data[shape];
      if (draw.shape)
        draw.shape(w.registry.idOf(body), s.def, w.registry.shapes.worldPose(shape, w.registry.bodies),
                   colourOf(w.registry.bodies.data[body]));
      if (draw.bounds && w.proximity.around[shape].proxy != kNoProxy) draw.bounds(w.proximity.kept(shape));
    }
    if (draw.line && lengthSquared(m.linearVelocity) > 0)
      draw.line(m.position, m.position + m.linearVelocity * 0.1, kVelocityColour);
    if (const Vec3 runs = w.registry.bodies.surfaceVelocity(body); draw.line && lengthSquared(runs) > 0)
      draw.line(m.position, m.position + runs * 0.1, kSurfaceColour);
  }
  if (draw.line)
    for (JointId id : joints()) {  // from centre to anchor, to anchor, to centre
      const JointState joint = *state(id);
      draw.line(state(joint.bodyA)->centreOfMass, joint.anchorA, kJointColour);
      draw.line(joint.anchorA, joint.anchorB, kJointColour);
      draw.line(joint.anchorB, state(joint.bodyB)->centreOfMass, kJointColour);
    }
  if (draw.contact)
    forEachContact([&](const ContactView& c) {
      for (int i = 0; i < c.pointCount; i++)
        draw.contact(c.points[i].pointWorld, c.normalWorld, c.points[i].normalForce);
    });
}

}  // namespace brickfall
