#include "world/hits.h"

#include <utility>

namespace brickfall {

void tellHit(const WorldDef& def, const Registry& registry, const Contact& contact, const ContactRecord& record,
             double speed, double impulse, std::vector<HitEvent>& out) {
  if (speed < def.hitEventSpeed || impulse < def.hitEventImpulse) return;
  const BodySet& bodies = registry.bodies;
  HitEvent hit;
  hit.bodyA = registry.idOf(contact.bodyA);
  hit.bodyB = registry.idOf(contact.bodyB);
  hit.normalWorld = toDouble(record.n);
  hit.pointWorld = bodies.motion[contact.bodyA].position + toDouble(record.armA);
  if (bodies.data[contact.bodyB].order < bodies.data[contact.bodyA].order) {
    std::swap(hit.bodyA, hit.bodyB);
    hit.normalWorld = -hit.normalWorld;
  }
  hit.approachSpeed = speed;
  hit.impulse = impulse;
  out.push_back(hit);
}

}  // namespace brickfall
