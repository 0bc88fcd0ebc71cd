// Sleep: islands that rested for sleepDelay leave all lists that the step walks. A body that touches them wakes them
// (upkeep.cpp).
//
// Everything of a sleeping island stays as it is (contacts, forces, hierarchies), so that it wakes as it fell asleep.
#include <algorithm>

#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

void fallAsleep(const WorldDef& def, double dt, Registry& registry, Activity& activity, Ties& ties, Diary& diary) {
  BodySet& bodies = registry.bodies;
  IslandSet& islands = activity.islands;
  activity.sleptNow = 0;
  for (IslandPointer& island : islands.awake) {
    diary.report.islandEndings[std::size_t(island->ending)]++;
    if (island->settled()) island->rows.eachKind([](auto& kind) { kind.giveRoom(); });
    island->restTime = island->resting() ? island->restTime + dt : 0;
    bool sleeps = def.enableSleep && !island->facts.partnersMove && island->restTime >= def.sleepDelay &&
                  std::all_of(island->bodies.begin(), island->bodies.end(),
                              [&](BodyIndex body) { return bodies.data[body].allowSleep; });
    if (!sleeps) continue;
    activity.sleptNow++;
    for (BodyIndex body : island->bodies) {
      bodies.data[body].activity = BodyActivity::asleep;
      bodies.data[body].linearAcceleration = bodies.data[body].angularAcceleration = {};
      bodies.still[body] = 1;
      activity.islandOf[body] = kNoIndex;
      diary.events.fellAsleep.push_back(registry.idOf(body));
    }
    island->rows.eachKind([](auto& kind) { kind.giveRoom(); });
    islands.asleep.push_back(std::move(island));
  }
  if (activity.sleptNow == 0) return;
  std::erase(islands.awake, nullptr);
  activity.renumberIslands();
  auto isAwake = [&](BodyIndex body) { return bodies.data[body].activity == BodyActivity::awake; };
  std::erase_if(activity.awake, [&](BodyIndex body) { return !isAwake(body); });
  ties.sleepWhere([&](BodyIndex a, BodyIndex b) {
    return !isAwake(a) && !isAwake(b) && !bodies.isDriven(a) && !bodies.isDriven(b);
  });
}

void hashSleep(const Registry& registry, const IslandSet& islands, HashItems& out) {
  for (const auto* list : {&islands.awake, &islands.asleep})
    out.islands(*list, [&](Mix& h, const Island& i) { h(int(registry.bodies.data[i.key()].activity), i.restTime); });
}

}  // namespace brickfall
