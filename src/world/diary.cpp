#include "world/diary.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/keep_room.h"

namespace brickfall {

ContactEvent byCreation(TouchingPair pair, const Registry& registry) {
  const auto& data = registry.bodies.data;
  if (data[pair.second].order < data[pair.first].order) {
    std::swap(pair.first, pair.second);
    std::swap(pair.shapeFirst, pair.shapeSecond);
  }
  return {registry.idOf(pair.first), registry.idOf(pair.second), registry.idOfShape(pair.shapeFirst),
          registry.idOfShape(pair.shapeSecond)};
}

void appendTouching(const Island& island, const Ties& ties, TouchingPairs& out) {
  island.rows.eachKind([&](const auto& kind) {
    kind.eachTouching(ties, [&](const Contact& c) {
      const bool inOrder = c.bodyA < c.bodyB;
      out.push_back(inOrder ? TouchingPair{c.bodyA, c.bodyB, c.shapeA, c.shapeB}
                            : TouchingPair{c.bodyB, c.bodyA, c.shapeB, c.shapeA});
    });
  });
}

// Both lists of events keep their memory.
void Diary::tellPending() {
  auto clear = [](auto&... lists) { (lists.clear(), ...); };
  clear(events.begin, events.hits, events.breaks, events.sensorBegin, events.sensorEnd, events.moved,
        events.fellAsleep);
  events.mortar.assign(pending.mortar.begin(), pending.mortar.end());
  events.end.assign(pending.end.begin(), pending.end.end());
  events.woke.assign(pending.woke.begin(), pending.woke.end());
  clear(pending.mortar, pending.end, pending.woke);
}

void Diary::addTouching(const Island& island, const Ties& ties) {
  appendTouching(island, ties, touchingBefore);
  makeAscending(touchingBefore);
}

void Diary::endTouchingOf(BodyIndex body, const Registry& registry) {
  std::erase_if(touchingBefore, [&](const TouchingPair& pair) {
    if (pair.first != body && pair.second != body) return false;
    heard().end.push_back(byCreation(pair, registry));
    return true;
  });
}

void Diary::tellSensed() {
  makeAscending(sensedNow);
  std::set_difference(sensedNow.begin(), sensedNow.end(), sensed.begin(), sensed.end(),
                      std::back_inserter(events.sensorBegin));
  std::set_difference(sensed.begin(), sensed.end(), sensedNow.begin(), sensedNow.end(),
                      std::back_inserter(events.sensorEnd));
  sensed.swap(sensedNow);
}

void Diary::beginLedger(const Balance& now, bool firstPart) {
  LedgerState& s = ledgerState;
  s.now = now;
  s.quarantined = report.quarantined.size();
  if (!firstPart) return;
  StepLedger fresh;
  fresh.before = s.now;
  if (s.begun) fresh.outside = s.now - s.last;
  report.ledger = fresh;
}

void Diary::keepRoom(std::size_t slots, std::size_t touching) {
  for (TouchingPairs* list : {&touchingNow, &touchingBefore, &slept, &room}) brickfall::keepRoom(*list, touching);
  for (Events* e : {&events, &pending}) {
    for (auto* list : {&e->begin, &e->end}) brickfall::keepRoom(*list, touching);
    for (auto* list : {&e->fellAsleep, &e->woke}) keepRoomFor(*list, slots);
    keepRoomFor(e->moved, 2 * slots);  // bodies of several parts, before they are told apart
    brickfall::keepRoom(e->hits, touching);
  }
}

void Diary::checkStructure(Findings& f, const Registry& registry) const {
  for (const TouchingPair& pair : touchingBefore)
    f.expect(pair.first < registry.bodies.slots() && pair.second < registry.bodies.slots() &&
                 pair.shapeFirst < registry.shapes.slots() && pair.shapeSecond < registry.shapes.slots(),
             "touching: a body that is not there");
}

void Diary::check(Findings& f, const Registry& registry) const {
  f.expect(std::is_sorted(sensed.begin(), sensed.end()), "sensors: what they sense is not sorted");
  f.expect(isAscending(touchingBefore), "touching: not sorted, or twice");
  for (const TouchingPair& pair : touchingBefore)
    f.expect(pair.first < pair.second && registry.bodies.alive(pair.first) && registry.bodies.alive(pair.second) &&
                 registry.shapes.data[pair.shapeFirst].body == pair.first &&
                 registry.shapes.data[pair.shapeSecond].body == pair.second,
             "touching: a body or shape that is not there");
}

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
