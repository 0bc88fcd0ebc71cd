// The events for listeners: pairs of bodies that began or ceased to press on each other, bodies that moved.
#include <algorithm>
#include <iterator>

#include "world/activity.h"
#include "world/diary.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

// Rows lie in the order of their pairs, so the lists of islands are some ascending runs, one after the other.
// Neighbouring runs are merged until one is left. `room` is taken for it.
template <class T> void makeSet(std::vector<T>& list, std::vector<T>& room) {
  for (bool merged = true; merged;) {
    merged = false;
    room.clear();
    for (auto from = list.begin(); from != list.end();) {
      auto middle = std::is_sorted_until(from, list.end()), end = std::is_sorted_until(middle, list.end());
      std::merge(from, middle, middle, end, std::back_inserter(room));
      merged = merged || middle != end;
      from = end;
    }
    if (merged) list.swap(room);
  }
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

void countPoints(Island& island, const Ties& ties) {
  const PointCount count = island.rows.countPoints(ties);
  island.points = count.all;
  island.touchingPoints = count.touching;
}

// Bodies touch if any of their contacts does. Pairs that were not among those of the last step begin; pairs that are no
// longer among them end.
void collectTouching(const Registry& registry, const Activity& activity, const Ties& ties, Diary& diary) {
  TouchingPairs &now = diary.touchingNow, &before = diary.touchingBefore, &slept = diary.slept;
  now.clear();
  for (const IslandPointer& island : activity.islands.awake) appendTouching(*island, ties, now);
  // An island that fell asleep in this step still touches, but is not looked at again until it wakes.
  slept.clear();
  const auto& asleep = activity.islands.asleep;
  for (std::size_t i = asleep.size() - activity.sleptNow; i < asleep.size(); i++)
    appendTouching(*asleep[i], ties, slept);
  now.insert(now.end(), slept.begin(), slept.end());
  makeSet(now, diary.room);
  makeSet(slept, diary.room);
  auto tell = [&](const TouchingPairs& in, const TouchingPairs& notIn, std::vector<ContactEvent>& out) {
    auto other = notIn.begin();
    for (const TouchingPair& pair : in) {
      while (other != notIn.end() && *other < pair) ++other;
      if (other == notIn.end() || *other != pair) out.push_back(byCreation(pair, registry));
    }
  };
  tell(now, before, diary.events.begin);
  tell(before, now, diary.events.end);
  before.clear();
  std::set_difference(now.begin(), now.end(), slept.begin(), slept.end(), std::back_inserter(before));
}

}  // namespace

void collectEvents(const Registry& registry, Activity& activity, Ties& ties, Diary& diary) {
  StepReport& report = diary.report;
  for (IslandPointer& island : activity.islands.awake) {
    if (!island->settled()) countPoints(*island, ties);
    island->rows.eachManifold([&](ContactIndex) { report.manifolds++; });
    report.contactPoints += island->points;
    report.touchingPoints += island->touchingPoints;
  }
  if (ties.touchingChanged() || activity.sleptNow > 0) collectTouching(registry, activity, ties, diary);
  ties.touchingIsTold();

  std::vector<BodyId>& moved = diary.events.moved;
  const bool toldBefore = !moved.empty();  // in another part of the step, or of a call
  for (BodyIndex body : activity.awake)
    if (!registry.bodies.still[body]) moved.push_back(registry.idOf(body));
  for (BodyIndex body : activity.moving) moved.push_back(registry.idOf(body));
  if (toldBefore) makeAscending(moved);
}

void hashEvents(const Events& events, HashItems& out) {
  for (const auto* list : {&events.begin, &events.end})
    for (const ContactEvent& e : *list) out.add(e.bodyA, e.bodyB, Mix()(list == &events.begin));
  for (const HitEvent& e : events.hits)
    out.add(e.bodyA, e.bodyB, Mix()(e.pointWorld, e.normalWorld, e.approachSpeed, e.impulse));
  for (const auto* list : {&events.moved, &events.fellAsleep, &events.woke})
    for (BodyId body : *list) out.add(body, {}, Mix()(list == &events.moved, list == &events.woke));
}

}  // namespace brickfall
