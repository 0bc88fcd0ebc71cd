// Narrow phase: manifolds of candidate pairs, and the memory of their points. Sleeping islands wake if a body now meets
// them.
#include "world/narrow_phase.h"
#include "world/stage_hash.h"
#include "world/stages.h"
#include "world/upkeep.h"

namespace brickfall {

namespace {

// Wakes sleeping bodies on which an awake body presses, or which it is about to hit.
void wakeByNewContacts(const Registry& registry, const ContactSet& contacts, const StepContext& context,
                       Upkeep& upkeep) {
  auto asleep = [&](BodyIndex body) { return registry.bodies.data[body].activity == BodyActivity::asleep; };
  std::pmr::vector<BodyIndex> wake(context.memory);
  for (const CandidatePair& pair : contacts.pairs) {
    bool a = asleep(pair.bodyA);
    if ((a || asleep(pair.bodyB)) && pair.contact != kNoIndex) wake.push_back(a ? pair.bodyA : pair.bodyB);
  }
  for (BodyIndex body : wake) upkeep.wakeIslandOf(body);
}

}  // namespace

void updateContacts(const Registry& registry, const Activity& activity, const StepContext& context,
                    Proximity& proximity, StepReport& report, Upkeep& upkeep) {
  NarrowPhase narrow(registry, context.dt, proximity);
  narrow.run();
  report.manifoldsReused += narrow.reused();
  report.manifoldsComputed += narrow.computed();
  if (!proximity.contacts.asleep.empty() || !activity.islands.asleep.empty())
    wakeByNewContacts(registry, proximity.contacts, context, upkeep);
}

void hashContacts(const ContactSet& contacts, HashItems& out) {
  out.pairs(contacts.pairs, contacts, [](Mix& h, const Contact& c, const ContactGeometry& g) {
    mix(h, c);
    mix(h, g, c.count);
  });
}

}  // namespace brickfall
