// A tie between two bodies, whatever its kind: a link. And the functions of a
// set that owns all ties of one kind, which the compiler asks of each (ties.h).
#pragma once
#include <concepts>
#include <cstdint>

#include "base/archive.h"
#include "base/findings.h"
#include "base/mix.h"
#include "dynamics/body_set.h"

namespace brickfall {

class ShapeSet;

enum class LinkKind : std::uint8_t { contact, joint, mortar, count };
//! not of the method: a count
constexpr std::size_t kLinkKinds = std::size_t(LinkKind::count);

struct Link {
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  LinkKind kind = LinkKind::contact;
  std::uint32_t index = kNoIndex;  // in the set of its kind

  bool names(BodyIndex body) const { return bodyA == body || bodyB == body; }
};

// Anything that can be called with a link, or asked of two bodies: for TieSet.
struct AnyLinkVisit {
  void operator()(const Link&) const {}
};
struct AnyPairTest {
  bool operator()(BodyIndex, BodyIndex) const { return true; }
};

template <class Set>
concept TieSet = requires(Set& set, const Set& seen, BodyIndex body, std::uint32_t index, std::size_t room,
                          const BodySet& bodies, const ShapeSet& shapes, AnyLinkVisit visit, AnyPairTest test,
                          Mix& hash, WriteArchive& out, ReadArchive& in, Findings& findings) {
  requires Set::kLink < LinkKind::count;
  // visit(link), in the order of the set: ties of which at least one body is
  // awake, or moves; and those of which none is.
  seen.eachAwake(visit);
  seen.eachAsleep(visit);
  // Something sleeps, be it a tie yet or not.
  { seen.anyAsleep() } -> std::same_as<bool>;
  // Ties whose bodies fulfil test(a, b) fall asleep, or wake.
  set.sleepWhere(test);
  set.wakeWhere(test);
  // The body goes: its ties end.
  set.dropOf(body);
  // The body is put elsewhere, or its type or centre of mass changes: ties end that stand on its place, as contacts do.
  set.displace(body);
  // Whether the set lets shapes of these two bodies touch.
  { seen.mayCollide(body, body) } -> std::same_as<bool>;
  // The body's material has changed, and with it perhaps its mass.
  set.renewConstants(body, shapes, bodies);
  // A step begins, or a part of one: what the set tells of the last one is
  // forgotten.
  set.beginStep();
  // Ties came or went since islands were built; which of them press changed
  // since events were collected.
  { seen.changed } -> std::convertible_to<bool>;
  { seen.touchingChanged } -> std::convertible_to<bool>;
  // Room for a world of so many shapes, so that the step itself takes no
  // memory.
  set.keepRoom(room);
  // All that a tie remembers.
  seen.hash(hash, index);
  // A snapshot: out and in.
  seen.archive(out);
  set.archive(in);
  // What must hold before a tie may be followed; values that a snapshot may
  // have; all the rest.
  seen.checkStructure(findings, bodies, shapes);
  seen.checkRanges(findings);
  seen.check(findings, bodies, shapes);
};

}  // namespace brickfall
