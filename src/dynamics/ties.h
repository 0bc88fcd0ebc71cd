// All that ties bodies to each other: an owner of a world's state. It has a set
// for each kind of tie. Whatever asks what hangs together, falls asleep, wakes
// or goes asks here, and never which kind it is. The functions of every kind are
// those of ContactSet (contact_set.h).
#pragma once
#include <tuple>
#include <utility>

#include "dynamics/contact_set.h"
#include "dynamics/joint_set.h"
#include "dynamics/link.h"
#include "dynamics/mortar_set.h"

namespace brickfall {

class Ties {
 public:
  Ties() = default;
  Ties(const Ties&) = delete;
  Ties& operator=(const Ties&) = delete;

  ContactSet contacts;
  JointSet joints;
  MortarSet mortar;

  // In the order of LinkKind.
  auto kinds() { return std::tie(contacts, joints, mortar); }
  auto kinds() const { return std::tie(contacts, joints, mortar); }

  // visit(set) for each kind.
  template <class Visit> void eachKind(Visit&& visit) {
    std::apply([&](auto&... set) { (visit(set), ...); }, kinds());
  }
  template <class Visit> void eachKind(Visit&& visit) const {
    std::apply([&](const auto&... set) { (visit(set), ...); }, kinds());
  }

  // visit(link), kind by kind, each in the order of its set: ties of which at
  // least one body is awake, or moves; and those of which none is.
  template <class Visit> void eachAwake(Visit&& visit) const {
    eachKind([&](const auto& set) { set.eachAwake(visit); });
  }
  template <class Visit> void eachAsleep(Visit&& visit) const {
    eachKind([&](const auto& set) { set.eachAsleep(visit); });
  }
  bool anyAsleep() const {
    return any([](const auto& set) { return set.anyAsleep(); });
  }
  // Ties whose bodies fulfil leaves(a, b), or wakes(a, b).
  template <class Leaves> void sleepWhere(Leaves leaves) {
    eachKind([&](auto& set) { set.sleepWhere(leaves); });
  }
  template <class Wakes> void wakeWhere(Wakes wakes) {
    eachKind([&](auto& set) { set.wakeWhere(wakes); });
  }
  void dropOf(BodyIndex body) {
    eachKind([&](auto& set) { set.dropOf(body); });
  }
  // The body is put elsewhere, or its type or centre of mass changes.
  void displace(BodyIndex body) {
    eachKind([&](auto& set) { set.displace(body); });
  }
  // Whether shapes of these two bodies may touch: not where a tie forbids it.
  bool mayCollide(BodyIndex a, BodyIndex b) const {
    return !any([&](const auto& set) { return !set.mayCollide(a, b); });
  }
  void renewConstants(BodyIndex body, const ShapeSet& shapes, const BodySet& bodies) {
    eachKind([&](auto& set) { set.renewConstants(body, shapes, bodies); });
  }
  void beginStep() {
    eachKind([](auto& set) { set.beginStep(); });
  }

  // Ties came or went since the islands were built.
  bool changed() const {
    return any([](const auto& set) { return bool(set.changed); });
  }
  void islandsAreBuilt() {
    eachKind([](auto& set) { set.changed = false; });
  }
  // Which ties press changed since the events were collected.
  bool touchingChanged() const {
    return any([](const auto& set) { return bool(set.touchingChanged); });
  }
  void touchingIsTold() {
    eachKind([](auto& set) { set.touchingChanged = false; });
  }

  void keepRoom(std::size_t shapes) {
    eachKind([&](auto& set) { set.keepRoom(shapes); });
  }
  void hash(Mix& h, const Link& link) const {
    eachKind([&](const auto& set) {
      if (set.kLink == link.kind) set.hash(h, link.index);
    });
  }
  template <class Archive> void archive(Archive& a) {
    eachKind([&](auto& set) { set.archive(a); });
  }
  template <class Archive> void archive(Archive& a) const {
    eachKind([&](const auto& set) { set.archive(a); });
  }
  void checkStructure(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const {
    eachKind([&](const auto& set) { set.checkStructure(f, bodies, shapes); });
  }
  void checkRanges(Findings& f) const {
    eachKind([&](const auto& set) { set.checkRanges(f); });
  }
  void check(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const {
    eachKind([&](const auto& set) { set.check(f, bodies, shapes); });
  }

 private:
  template <class Test> bool any(Test test) const {
    return std::apply([&](const auto&... set) { return (test(set) || ...); }, kinds());
  }
};

// Each set stands where its kind says.
template <class... Sets> constexpr bool areInOrder(const std::tuple<Sets&...>*) {
  std::size_t place = 0;
  return sizeof...(Sets) == kLinkKinds && ((std::size_t(Sets::kLink) == place++) && ...);
}
static_assert(areInOrder(static_cast<decltype(std::declval<Ties&>().kinds())*>(nullptr)));

}  // namespace brickfall
