#include "world/upkeep.h"

#include <algorithm>

namespace brickfall {

BodyIndex Upkeep::create(BodyPlan&& plan) {
  BodyIndex body = registry_.add(std::move(plan));
  proximity_.enter(registry_, body);
  activity_.enlist(registry_.bodies, body);
  return body;
}

void Upkeep::destroy(BodyIndex body) {
  if (registry_.bodies.data[body].activity == BodyActivity::asleep) wakeIslandOf(body);
  removeContactsOf(body);
  proximity_.leave(registry_, body);
  activity_.delist(registry_.bodies, body);
  activity_.forgetIslandsOf(body);
  registry_.remove(body);
}

void Upkeep::setType(BodyIndex body, BodyType type) {
  if (registry_.bodies.data[body].activity == BodyActivity::asleep) wakeIslandOf(body);
  removeContactsOf(body);
  activity_.delist(registry_.bodies, body);
  registry_.setType(body, type);
  renewProxies(body);
  activity_.enlist(registry_.bodies, body);
  activity_.forgetIslandsOf(body);
}

void Upkeep::setPose(BodyIndex body, Vec3 position, Quat rotation) {
  disturb(body);
  removeContactsOf(body);
  registry_.setPose(body, position, rotation);
  renewProxies(body);
}

// A kinematic body joins or leaves the moving ones with its velocity.
void Upkeep::relist(BodyIndex body) {
  if (registry_.bodies.data[body].type != BodyType::kinematic) return;
  activity_.delist(registry_.bodies, body);
  activity_.enlist(registry_.bodies, body);
}

void Upkeep::isolate(BodyIndex body) {
  removeContactsOf(body);
  proximity_.leave(registry_, body);
  activity_.delist(registry_.bodies, body);
}

// Its pairs are found anew.
void Upkeep::renewProxies(BodyIndex body) {
  proximity_.leave(registry_, body);
  proximity_.enter(registry_, body);
}

void Upkeep::removeContactsOf(BodyIndex body) {
  wakeTouching(body);
  proximity_.dropPairsOf(body);
  diary_.endTouchingOf(body, registry_);
  activity_.membershipChanged = true;
}

void Upkeep::disturb(BodyIndex body) {
  BodySet& bodies = registry_.bodies;
  bodies.still[body] = 0;
  if (bodies.data[body].type != BodyType::dynamic) {
    activity_.countAsMoved(bodies, body);
    wakeTouching(body);
    // It may begin to move: its pairs are looked at, whoever sleeps.
    proximity_.contacts.moveFromSleep([&](const CandidatePair& p) { return p.bodyA == body || p.bodyB == body; });
    activity_.unsettlePartnersOf(body);
    return;
  }
  if (bodies.data[body].activity == BodyActivity::asleep) wakeIslandOf(body);
  activity_.unsettleIslandOf(body);
}

void Upkeep::wakeIslandOf(BodyIndex body) {
  const auto& asleep = activity_.islands.asleep;
  for (std::size_t i = 0; i < asleep.size(); i++)
    if (std::binary_search(asleep[i]->bodies.begin(), asleep[i]->bodies.end(), body)) {
      wakeIsland(i);
      return;
    }
}

void Upkeep::wakeIsland(std::size_t asleepIndex) {
  IslandSet& islands = activity_.islands;
  BodySet& bodies = registry_.bodies;
  IslandPointer island = std::move(islands.asleep[asleepIndex]);
  islands.asleep.erase(islands.asleep.begin() + std::ptrdiff_t(asleepIndex));
  for (BodyIndex body : island->bodies) {
    bodies.data[body].activity = BodyActivity::awake;
    bodies.still[body] = 0;
    activity_.awake.push_back(body);
    diary_.heard().woke.push_back(registry_.idOf(body));
  }
  std::sort(activity_.awake.begin(), activity_.awake.end());
  auto isAwake = [&](BodyIndex body) { return bodies.data[body].activity == BodyActivity::awake; };
  proximity_.contacts.moveFromSleep([&](const CandidatePair& p) { return isAwake(p.bodyA) || isAwake(p.bodyB); });
  diary_.addTouching(*island, proximity_.contacts);
  island->restTime = 0;
  island->ending = IslandEnding::unsolved;
  auto place = std::lower_bound(islands.awake.begin(), islands.awake.end(), island,
                                [](const auto& a, const auto& b) { return a->key() < b->key(); });
  islands.awake.insert(place, std::move(island));
  activity_.membershipChanged = true;
}

void Upkeep::wakeAll() {
  while (!activity_.islands.asleep.empty()) wakeIsland(activity_.islands.asleep.size() - 1);
  activity_.unsettleAll();
  for (auto& island : activity_.islands.awake) island->restTime = 0;
}

void Upkeep::wakeTouching(BodyIndex body) {
  std::vector<BodyIndex> wake;
  for (const CandidatePair& pair : proximity_.contacts.asleep)
    if ((pair.bodyA == body || pair.bodyB == body) && pair.contact != kNoIndex)
      wake.push_back(pair.bodyA == body ? pair.bodyB : pair.bodyA);
  for (BodyIndex other : wake)
    if (registry_.bodies.data[other].activity == BodyActivity::asleep) wakeIslandOf(other);
}

}  // namespace brickfall
