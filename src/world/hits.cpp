#include "world/hits.h"

#include <utility>

namespace brickfall {

void tellHit(const WorldDef& def, const Registry& registry, const ContactRows& rows, const ContactImpact& impact,
             const StepContext& context, std::vector<HitEvent>& out) {
  if (impact.speed < def.hitEventSpeed || impact.impulse < def.hitEventImpulse) return;
  const ContactRecord& record = rows.records[impact.row];
  const Contact& contact = context.contacts->contacts[record.contact];
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
  hit.approachSpeed = impact.speed;
  hit.impulse = impact.impulse;
  out.push_back(hit);
}

}  // namespace brickfall
