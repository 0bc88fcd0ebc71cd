// Broad phase: bounds of bodies that moved, and new candidate pairs.
#include <algorithm>

#include "dynamics/ties.h"
#include "world/activity.h"
#include "world/proximity.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void findPairs(const Registry& registry, const Activity& activity, const StepContext& context, Proximity& proximity,
               Ties& ties) {
  const BodySet& bodies = registry.bodies;
  const ShapeSet& shapes = registry.shapes;
  proximity.fall = context.gravity * context.dt;
  proximity.following.clear();
  for (const auto* list : {&activity.awake, &activity.moving})
    for (BodyIndex body : *list) {
      if (bodies.still[body]) continue;
      for (ShapeIndex shape : bodies.shapes[body]) {
        proximity.updateSwept(registry, shape, context.dt);
        proximity.follow(registry, shape);
      }
    }
  proximity.broadPhase->updateAll(proximity.following);

  auto wanted = [&](std::uint32_t a, std::uint32_t b) {
    return registry.mayMeet(a, b) && ties.mayCollide(shapes.data[a].body, shapes.data[b].body);
  };
  ContactSet& contacts = ties.contacts;
  proximity.foundPairs.clear();
  proximity.broadPhase->newPairs(wanted, proximity.foundPairs);
  proximity.newPairs.clear();
  for (const auto& [a, b] : proximity.foundPairs) {
    CandidatePair pair{a, b, shapes.data[a].body, shapes.data[b].body, kNoIndex, 0};
    // A pair that sleeps waits in the other list; it wakes with its island.
    bool known = std::binary_search(contacts.asleep.begin(), contacts.asleep.end(), pair);
    if (!known) proximity.newPairs.push_back(pair);
  }
  contacts.insert(proximity.newPairs);
}

void hashPairs(const Registry& registry, const Activity& activity, const Proximity& proximity, HashItems& out) {
  for (const auto* list : {&activity.awake, &activity.moving})
    out.bodies(*list, [&](Mix& h, BodyIndex body) {
      for (ShapeIndex shape : registry.bodies.shapes[body]) h(proximity.around[shape].swept);
    });
}

}  // namespace brickfall
