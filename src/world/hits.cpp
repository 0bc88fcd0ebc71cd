#include "world/hits.h"

#include <utility>

namespace brickfall {

namespace {

HitEvent hitOf(const Registry& registry, const Contact& contact, const ContactRecord& record,
               const ContactImpact& impact) {
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
  return hit;
}

}  // namespace

void tellHits(const WorldDef& def, const Registry& registry, const Island& island,
              const std::pmr::vector<ContactImpact>& impacts, const StepContext& context, std::vector<HitEvent>& out) {
  for (const ContactImpact& impact : impacts) {
    if (impact.speed < def.hitEventSpeed || impact.impulse < def.hitEventImpulse) continue;
    const ContactIndex contact = island.rows.contacts.contactOf[impact.row];
    out.push_back(
        hitOf(registry, context.ties->contacts.contacts[contact], island.rows.contacts.records[impact.row], impact));
  }
}

}  // namespace brickfall
