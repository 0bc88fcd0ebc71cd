// What listeners are told: contacts that began or ended to press, impacts, bodies that moved.
#include <algorithm>
#include <iterator>

#include "world/world_impl.h"

namespace brickfall {

namespace {

// The impact of a contact in the step just made: fastest approach and impulse over its points.
struct ContactImpact {
  double speed = 0, impulse = 0;
};

ContactImpact impactOf(const Contact& c, const ContactStart& start, double dt) {
  ContactImpact out;
  for (int i = 0; i < c.count; i++) {
    if (!(c.points.forceN[i] > 0)) continue;
    out.speed = std::max(out.speed, double(-start.approach[i]));
    out.impulse += double(c.points.forceN[i]) * dt;
  }
  return out;
}

template <class T> void makeSet(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

// Slots are used again, so their order is not that of creation.
World::Impl::BodyPair World::Impl::byCreation(BodyPair pair) const {
  if (bodies.data[pair.second].order < bodies.data[pair.first].order) std::swap(pair.first, pair.second);
  return pair;
}

// Pairs of bodies that press on each other; a pair comes once for each of its contacts.
void World::Impl::appendTouching(const Island& island, BodyPairs& out) const {
  for (ContactIndex contact : island.rows.contacts.contactOf) {
    const Contact& c = contacts.contacts[contact];
    if (c.touching) out.push_back({std::min(c.bodyA, c.bodyB), std::max(c.bodyA, c.bodyB)});
  }
}

void World::Impl::collectEvents() {
  StageTimer timer(report, Stage::events);
  for (auto& island : islands.awake) {
    if (!island->settled()) countPoints(*island);
    report.manifolds += int(island->rows.contacts.contactOf.size());
    report.contactPoints += island->points;
    report.touchingPoints += island->touchingPoints;
  }
  if (contacts.touchingChanged || sleptNow > 0) collectTouching();
  contacts.touchingChanged = false;

  for (BodyIndex body : awake)
    if (!bodies.still[body]) events.moved.push_back(idOf(body));
  for (BodyIndex body : moving) events.moved.push_back(idOf(body));
}

void World::Impl::countPoints(Island& island) const {
  island.points = island.touchingPoints = 0;
  for (ContactIndex contact : island.rows.contacts.contactOf) {
    const Contact& c = contacts.contacts[contact];
    island.points += c.count;
    for (int i = 0; i < c.count; i++) island.touchingPoints += c.points.forceN[i] > 0;
  }
}

// Called when the forces are stored: restitution forgets those of the impacts that it answers.
void World::Impl::collectHits(const Island& island) {
  for (std::size_t k = 0; k < island.rows.contacts.contactOf.size(); k++) {
    const Contact& c = contacts.contacts[island.rows.contacts.contactOf[k]];
    if (!c.touching) continue;
    ContactImpact impact = impactOf(c, island.rows.contacts.starts[k], context.dt);
    if (impact.speed >= def.hitEventSpeed && impact.impulse >= def.hitEventImpulse)
      addHit(island, k, impact.speed, impact.impulse);
  }
}

// Bodies touch if any of their contacts does. Pairs that were not among those of the last step begin, and the other way.
void World::Impl::collectTouching() {
  touchingNow.clear();
  for (auto& island : islands.awake) appendTouching(*island, touchingNow);
  // What fell asleep in this step still touches, but is not looked at again until it wakes.
  slept.clear();
  for (std::size_t i = islands.asleep.size() - sleptNow; i < islands.asleep.size(); i++)
    appendTouching(*islands.asleep[i], slept);
  touchingNow.insert(touchingNow.end(), slept.begin(), slept.end());
  makeSet(touchingNow);
  makeSet(slept);
  auto tell = [&](const BodyPairs& in, const BodyPairs& notIn, std::vector<ContactEvent>& out) {
    for (const BodyPair& pair : in) {
      if (std::binary_search(notIn.begin(), notIn.end(), pair)) continue;
      BodyPair ordered = byCreation(pair);
      out.push_back({idOf(ordered.first), idOf(ordered.second)});
    }
  };
  tell(touchingNow, touchingBefore, events.begin);
  tell(touchingBefore, touchingNow, events.end);
  touchingBefore.clear();
  std::set_difference(touchingNow.begin(), touchingNow.end(), slept.begin(), slept.end(),
                      std::back_inserter(touchingBefore));
}

void World::Impl::addHit(const Island& island, std::size_t k, double speed, double impulse) {
  const Contact& c = contacts.contacts[island.rows.contacts.contactOf[k]];
  const ContactRecord& r = island.rows.contacts.records[k];
  HitEvent hit;
  hit.bodyA = idOf(c.bodyA);
  hit.bodyB = idOf(c.bodyB);
  hit.normalWorld = toDouble(r.n);
  hit.pointWorld = bodies.motion[c.bodyA].position + toDouble(r.armA);
  if (bodies.data[c.bodyB].order < bodies.data[c.bodyA].order) {
    std::swap(hit.bodyA, hit.bodyB);
    hit.normalWorld = -hit.normalWorld;
  }
  hit.approachSpeed = speed;
  hit.impulse = impulse;
  events.hits.push_back(hit);
}

}  // namespace brickfall
