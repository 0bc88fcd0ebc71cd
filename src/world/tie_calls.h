// Parts of the calls that are the same for every kind of tie that a program makes (joints.cpp, mortar.cpp): its ids,
// and its two bodies.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "dynamics/lasting_ties.h"
#include "world/checks.h"
#include "world/registry.h"

namespace brickfall {

template <class Id, class Set> Id tieId(const Set& set, std::uint32_t tie, const Registry& registry) {
  return {tie + 1, set.slots[tie].generation, registry.worldNumber};
}

// `kind`: for the message, "joint".
template <class Set, class Id>
Result<std::uint32_t> findTie(const Set& set, Id id, const Registry& registry, const std::string& kind) {
  return slotOf(id, registry.worldNumber, kind,
                [&](std::uint32_t tie) { return set.has(tie) && set.slots[tie].generation == id.generation; });
}

// In the order of creation, those that `wanted` says of.
template <class Id, class Set, class Wanted>
std::vector<Id> tieIds(const Set& set, const Registry& registry, Wanted&& wanted) {
  std::vector<Id> out;
  for (std::uint32_t tie : set.inOrder())
    if (wanted(set.slots[tie])) out.push_back(tieId<Id>(set, tie, registry));
  return out;
}
template <class Id, class Set> std::vector<Id> tieIds(const Set& set, const Registry& registry, BodyId of) {
  Result<BodyIndex> body = registry.find(of);
  if (!body) return {};
  return tieIds<Id>(set, registry, [&](const auto& tie) { return tie.names(*body); });
}

// The bodies that a definition ties, if they can be tied and `checkRest(checks)` finds nothing wrong with the rest.
template <class Def, class CheckRest>
Result<std::pair<BodyIndex, BodyIndex>> bodiesToTie(const Def& def, const Registry& registry, CheckRest&& checkRest) {
  Result<BodyIndex> a = registry.find(def.bodyA), b = registry.find(def.bodyB);
  if (!a) return Error{a.error().code, "bodyA: " + a.error().message};
  if (!b) return Error{b.error().code, "bodyB: " + b.error().message};
  Checks check;
  check.condition(*a != *b, "bodyB: found the same body as bodyA, expected another");
  checkRest(check);
  const BodyData &dataA = registry.bodies.data[*a], &dataB = registry.bodies.data[*b];
  check.condition(!dataA.quarantined && !dataB.quarantined,
                  "bodyA, bodyB: found a quarantined body, expected two that move");
  check.condition(dataA.type == BodyType::dynamic || dataB.type == BodyType::dynamic,
                  "bodyA, bodyB: found two bodies that nothing moves, expected a dynamic one");
  if (check.failed()) return check.error();
  return std::pair{*a, *b};
}

}  // namespace brickfall
