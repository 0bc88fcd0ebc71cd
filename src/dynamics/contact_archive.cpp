// Contacts as bytes, and as a hash.
#include <type_traits>

#include "dynamics/contact_set.h"

namespace brickfall {

namespace {

// The memory of points: numbers as they are, each phase checked as a value of
// PointPhase.
template <class Archive> struct PointFields {
  Archive& archive;
  template <class T> void operator()(T& lanes, PointQuantity = {}) const {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(lanes)>, PointPhase[4]>)
      for (auto& phase : lanes) archive.choice(phase, PointPhase::resting);
    else
      archive.value(lanes);
  }
};

template <class Archive, class One> void archiveContact(Archive& a, One& c) {
  for (auto* index : {&c.shapeA, &c.shapeB, &c.bodyA, &c.bodyB}) a.value(*index);
  for (auto* flag : {&c.rolls, &c.partial, &c.touching, &c.struck, &c.fresh, &c.born}) a.flag(*flag);
  for (auto* flag : {&c.crushed, &c.edited}) a.flag(*flag);
  for (auto* number : {&c.friction, &c.restitution, &c.rolling, &c.rollingRadius, &c.crushing, &c.effectiveMass})
    a.value(*number);
  eachField(c.points, PointFields<Archive>{a});
}

// The length of a list of structures that are read field by field.
template <class Archive, class List> void archiveLength(Archive& a, List& list, std::size_t leastSize) {
  std::uint64_t n = a.count(list.size(), leastSize);
  if constexpr (Archive::kReading) list.resize(std::size_t(n));
}

struct MixPoints {
  Mix& h;
  int count;
  template <class T> void operator()(const T (&lanes)[4], PointQuantity = {}) const { h.list(lanes, count); }
  void operator()(std::uint32_t mask) const { h(mask); }
};

}  // namespace

template <class Archive, class Set> void ContactSet::archiveAll(Archive& a, Set& set) {
  a.list(set.pairs);
  a.list(set.asleep);
  archiveLength(a, set.contacts, sizeof(std::int32_t));
  archiveLength(a, set.geometry, sizeof(std::int32_t));
  for (std::size_t i = 0; i < set.contacts.size(); i++) {
    a.value(set.contacts[i].count);
    if (set.contacts[i].count == 0) continue;  // a free slot
    archiveContact(a, set.contacts[i]);
    if (i < set.geometry.size()) a.value(set.geometry[i]);
  }
  a.flag(set.changed);
  a.list(set.struck);
  a.list(set.free_);
}

void ContactSet::archive(WriteArchive& a) const { archiveAll(a, *this); }
void ContactSet::archive(ReadArchive& a) { archiveAll(a, *this); }

void mix(Mix& h, const Contact& c) {
  h(c.shapeA, c.shapeB, c.count, c.rolls, c.partial, c.touching, c.friction, c.restitution, c.crushing, c.crushed,
    c.effectiveMass);
  eachField(c.points, MixPoints{h, c.count});
  if (resistsRolling(c)) h(c.rolling, c.rollingRadius, c.points.force1[kRollingLane], c.points.force2[kRollingLane]);
}

void ContactSet::hash(Mix& h, ContactIndex contact) const {
  const ContactGeometry& g = geometry[contact];
  const int count = contacts[contact].count;
  mix(h, contacts[contact]);
  h(g.relativePosition, g.relativeRotation, g.normal, g.tangent1, g.centre);
  h.list(g.anchorA, count).list(g.anchorB, count);
}

}  // namespace brickfall
