// Sleep: islands that rested for sleepDelay leave all lists that the step walks; what touches them wakes them.
//
// Everything of a sleeping island stays as it is (contacts, forces, hierarchies), so that it wakes as it fell asleep.
#include <algorithm>

#include "world/world_impl.h"

namespace brickfall {

void World::Impl::updateSleep() {
  StageTimer timer(report, Stage::sleep);
  bool any = false;
  sleptNow = 0;
  for (auto& island : islands.awake) {
    report.islandEndings[std::size_t(island->ending)]++;
    island->restTime = island->resting() ? island->restTime + context.dt : 0;
    bool sleeps = def.enableSleep && !island->facts.partnersMove && island->restTime >= def.sleepDelay &&
                  std::all_of(island->bodies.begin(), island->bodies.end(),
                              [&](BodyIndex body) { return bodies.data[body].allowSleep; });
    if (!sleeps) continue;
    any = true;
    sleptNow++;
    for (BodyIndex body : island->bodies) {
      bodies.data[body].activity = BodyActivity::asleep;
      bodies.data[body].linearAcceleration = bodies.data[body].angularAcceleration = {};
      bodies.still[body] = 1;
      islandOf[body] = kNoIndex;
      events.fellAsleep.push_back(idOf(body));
    }
    islands.asleep.push_back(std::move(island));
  }
  if (!any) return;
  std::erase(islands.awake, nullptr);
  for (std::size_t i = 0; i < islands.awake.size(); i++)
    for (BodyIndex body : islands.awake[i]->bodies) islandOf[body] = std::uint32_t(i);
  auto isAwake = [&](BodyIndex body) { return bodies.data[body].activity == BodyActivity::awake; };
  std::erase_if(awake, [&](BodyIndex body) { return !isAwake(body); });
  contacts.moveToSleep([&](const CandidatePair& p) {
    return !isAwake(p.bodyA) && !isAwake(p.bodyB) && !moves(p.bodyA) && !moves(p.bodyB);
  });
}

// A kinematic body with a velocity: its pairs are looked at in every step, whoever sleeps.
bool World::Impl::moves(BodyIndex body) const {
  const BodyMotion& m = bodies.motion[body];
  return bodies.data[body].type == BodyType::kinematic &&
         (lengthSquared(m.linearVelocity) > 0 || lengthSquared(m.angularVelocity) > 0);
}

// Pairs of a body that begins to move though it is not dynamic.
void World::Impl::activatePairsOf(BodyIndex body) {
  contacts.moveFromSleep([&](const CandidatePair& p) { return p.bodyA == body || p.bodyB == body; });
}

// A sleeping body that something awake presses on, or is about to hit.
void World::Impl::wakeByNewContacts() {
  std::pmr::vector<BodyIndex> wake(&stepMemory);
  for (const CandidatePair& pair : contacts.pairs) {
    bool a = bodies.data[pair.bodyA].activity == BodyActivity::asleep;
    bool b = bodies.data[pair.bodyB].activity == BodyActivity::asleep;
    if ((a || b) && pair.contact != kNoIndex) wake.push_back(a ? pair.bodyA : pair.bodyB);
  }
  for (BodyIndex body : wake) wakeIslandOf(body);
}

void World::Impl::wakeIslandOf(BodyIndex body) {
  for (std::size_t i = 0; i < islands.asleep.size(); i++)
    if (std::binary_search(islands.asleep[i]->bodies.begin(), islands.asleep[i]->bodies.end(), body)) {
      wakeIsland(i);
      return;
    }
}

void World::Impl::wakeIsland(std::size_t asleepIndex) {
  IslandPointer island = std::move(islands.asleep[asleepIndex]);
  islands.asleep.erase(islands.asleep.begin() + std::ptrdiff_t(asleepIndex));
  for (BodyIndex body : island->bodies) {
    bodies.data[body].activity = BodyActivity::awake;
    bodies.still[body] = 0;
    awake.push_back(body);
    heard().woke.push_back(idOf(body));
  }
  std::sort(awake.begin(), awake.end());
  auto isAwake = [&](BodyIndex body) { return bodies.data[body].activity == BodyActivity::awake; };
  contacts.moveFromSleep([&](const CandidatePair& p) { return isAwake(p.bodyA) || isAwake(p.bodyB); });
  appendTouching(*island, touchingBefore);
  std::sort(touchingBefore.begin(), touchingBefore.end());
  touchingBefore.erase(std::unique(touchingBefore.begin(), touchingBefore.end()), touchingBefore.end());
  island->restTime = 0;
  island->ending = IslandEnding::unsolved;
  auto place = std::lower_bound(islands.awake.begin(), islands.awake.end(), island,
                                [](const auto& a, const auto& b) { return a->key() < b->key(); });
  islands.awake.insert(place, std::move(island));
  membershipChanged = true;
}

void World::Impl::wakeAll() {
  while (!islands.asleep.empty()) wakeIsland(islands.asleep.size() - 1);
  for (auto& island : islands.awake) {
    island->unsettle();
    island->restTime = 0;
  }
}

// Sleeping islands that have a contact with the body.
void World::Impl::wakeTouching(BodyIndex body) {
  std::vector<BodyIndex> wake;
  for (const CandidatePair& pair : contacts.asleep)
    if ((pair.bodyA == body || pair.bodyB == body) && pair.contact != kNoIndex)
      wake.push_back(pair.bodyA == body ? pair.bodyB : pair.bodyA);
  for (BodyIndex other : wake)
    if (bodies.data[other].activity == BodyActivity::asleep) wakeIslandOf(other);
}

void World::Impl::disturb(BodyIndex body) {
  bodies.still[body] = 0;
  if (bodies.data[body].type != BodyType::dynamic) {
    countAsMoved(body);
    wakeTouching(body);
    activatePairsOf(body);
    for (auto& island : islands.awake)
      if (std::find(island->partners.begin(), island->partners.end(), body) != island->partners.end())
        island->unsettle();
    return;
  }
  if (bodies.data[body].activity == BodyActivity::asleep) wakeIslandOf(body);
  if (body < islandOf.size() && islandOf[body] != kNoIndex && islandOf[body] < islands.awake.size() &&
      !membershipChanged) {
    islands.awake[islandOf[body]]->unsettle();
    islands.awake[islandOf[body]]->restTime = 0;
  } else {
    for (auto& island : islands.awake)
      if (std::binary_search(island->bodies.begin(), island->bodies.end(), body)) island->unsettle();
  }
}

}  // namespace brickfall
