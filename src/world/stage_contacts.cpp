// Narrow phase: manifolds of candidate pairs, and the memory of their points. Sleeping islands wake if a body now meets
// them.
#include "world/narrow_phase.h"
#include "world/pre_solve.h"
#include "world/stage_hash.h"
#include "world/stages.h"
#include "world/upkeep.h"

namespace brickfall {

namespace {

// Wakes sleeping bodies on which an awake body presses, or which it is about to hit.
void wakeByNewTies(const Registry& registry, const Ties& ties, const StepContext& context, Upkeep upkeep) {
  auto asleep = [&](BodyIndex body) { return registry.bodies.data[body].activity == BodyActivity::asleep; };
  std::pmr::vector<BodyIndex> wake(context.memory);
  ties.eachAwake([&](const Link& link) {
    bool a = asleep(link.bodyA);
    if (a || asleep(link.bodyB)) wake.push_back(a ? link.bodyA : link.bodyB);
  });
  for (BodyIndex body : wake) upkeep.wakeIslandOf(body);
}

}  // namespace

void updateContacts(const PreSolveCall& preSolve, Registry& registry, const Activity& activity,
                    const StepContext& context, Proximity& proximity, Ties& ties, StepReport& report, Upkeep upkeep) {
  NarrowPhase narrow(registry, context.dt, proximity, ties.contacts);
  narrow.run();
  report.manifoldsReused += narrow.reused();
  report.manifoldsComputed += narrow.computed();
  if (preSolve) askPreSolve(preSolve, registry, ties, upkeep);
  if (ties.anyAsleep() || !activity.islands.asleep.empty()) wakeByNewTies(registry, ties, context, upkeep);
}

void hashContacts(const Ties& ties, HashItems& out) { ties.eachAwake(out.links(ties)); }

}  // namespace brickfall
