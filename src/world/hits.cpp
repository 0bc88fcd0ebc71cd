#include "world/hits.h"

#include <utility>

namespace brickfall {

namespace {

HitEvent hitOf(const Registry& registry, const TieImpact& impact) {
  const BodySet& bodies = registry.bodies;
  HitEvent hit;
  hit.bodyA = registry.idOf(impact.bodyA);
  hit.bodyB = registry.idOf(impact.bodyB);
  hit.shapeA = registry.idOfShape(impact.shapeA);
  hit.shapeB = registry.idOfShape(impact.shapeB);
  hit.normalWorld = impact.normal;
  hit.pointWorld = impact.point;
  if (bodies.data[impact.bodyB].order < bodies.data[impact.bodyA].order) {
    std::swap(hit.bodyA, hit.bodyB);
    std::swap(hit.shapeA, hit.shapeB);
    hit.normalWorld = -hit.normalWorld;
  }
  hit.approachSpeed = impact.speed;
  hit.impulse = impact.impulse;
  return hit;
}

}  // namespace

void tellHits(const WorldDef& def, const Registry& registry, const std::pmr::vector<TieImpact>& impacts,
              std::vector<HitEvent>& out) {
  for (const TieImpact& impact : impacts)
    if (!(impact.speed < def.hitEventSpeed || impact.impulse < def.hitEventImpulse))
      out.push_back(hitOf(registry, impact));
}

}  // namespace brickfall
