#include "world/activity.h"

#include <algorithm>

#include "base/keep_room.h"

namespace brickfall {

namespace {

template <class List> bool contains(const List& list, BodyIndex body) {
  return std::binary_search(list.begin(), list.end(), body);
}

bool isPartner(const Island& island, BodyIndex body) {
  return std::find(island.partners.begin(), island.partners.end(), body) != island.partners.end();
}

}  // namespace

void Activity::enlist(BodySet& bodies, BodyIndex body) {
  BodyData& data = bodies.data[body];
  membershipChanged = true;
  if (!bodies.takesPart(body)) {
    data.activity = BodyActivity::fixed;
    bodies.still[body] = 1;
    return;
  }
  data.activity = data.type == BodyType::dynamic ? BodyActivity::awake : BodyActivity::fixed;
  bodies.still[body] = 0;
  if (data.type == BodyType::dynamic) insertAscending(awake, body);
  if (bodies.isDriven(body)) insertAscending(moving, body);
  if (data.type != BodyType::dynamic) countAsMoved(bodies, body);
}

// The body's pairs are looked at in the next step, though neither side may move.
void Activity::countAsMoved(BodySet& bodies, BodyIndex body) {
  bodies.still[body] = 0;
  insertAscending(unsettled, body);
}

void Activity::delist(BodySet& bodies, BodyIndex body) {
  for (auto* list : {&awake, &moving, &unsettled, &pushed}) std::erase(*list, body);
  bodies.data[body].force = bodies.data[body].torque = {};
  bodies.still[body] = 1;
  bodies.data[body].activity = BodyActivity::fixed;
  membershipChanged = true;
}

void Activity::settleUnmoved(BodySet& bodies) {
  for (BodyIndex body : unsettled) bodies.still[body] = 1;
  unsettled.clear();
}

void Activity::push(BodyIndex body) { insertAscending(pushed, body); }

void Activity::dropForces(BodySet& bodies) {
  for (BodyIndex body : pushed) bodies.data[body].force = bodies.data[body].torque = {};
  pushed.clear();
}

void Activity::forgetIslandsOf(BodyIndex body) {
  std::erase_if(islands.awake, [&](const IslandPointer& island) {
    return contains(island->bodies, body) || isPartner(*island, body);
  });
  std::erase(islands.single, body);
  islandOf.clear();
  membershipChanged = true;
}

void Activity::unsettleIslandOf(BodyIndex body) {
  if (body < islandOf.size() && islandOf[body] != kNoIndex && islandOf[body] < islands.awake.size() &&
      !membershipChanged) {
    islands.awake[islandOf[body]]->unsettle();
    islands.awake[islandOf[body]]->restTime = 0;
    return;
  }
  for (auto& island : islands.awake)
    if (contains(island->bodies, body)) island->unsettle();
}

void Activity::unsettlePartnersOf(BodyIndex body) {
  for (auto& island : islands.awake)
    if (isPartner(*island, body)) island->unsettle();
}

void Activity::unsettleAll() {
  for (auto& island : islands.awake) island->unsettle();
}

void Activity::renumberIslands() {
  for (std::size_t i = 0; i < islands.awake.size(); i++)
    for (BodyIndex body : islands.awake[i]->bodies) islandOf[body] = std::uint32_t(i);
}

void Activity::keepRoom(std::size_t dynamicBodies, std::size_t slots) {
  islands.keepRoom(dynamicBodies);
  keepRoomFor(awake, dynamicBodies);
  keepRoomFor(islandOf, slots);
}

}  // namespace brickfall
