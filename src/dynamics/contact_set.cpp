#include "dynamics/contact_set.h"

#include <algorithm>

#include "base/keep_room.h"
#include "dynamics/shape_set.h"

namespace brickfall {

void ContactSet::strike(ContactIndex contact) {
  if (contacts[contact].struck) return;
  contacts[contact].struck = touchingChanged = true;
  struck.push_back(contact);
}
void ContactSet::beginStep() {
  for (ContactIndex contact : struck) {
    contacts[contact].struck = false;
    for (int i = 0; i < 4; i++) endHit(contacts[contact].points, i);
  }
  touchingChanged = touchingChanged || !struck.empty();
  struck.clear();
}

void ContactSet::dropOf(BodyIndex body) {
  dropWhere([&](const CandidatePair& pair) { return pair.bodyA == body || pair.bodyB == body; });
}
void ContactSet::dropBetween(BodyIndex a, BodyIndex b) {
  dropWhere([&](const CandidatePair& pair) {
    return (pair.bodyA == a && pair.bodyB == b) || (pair.bodyA == b && pair.bodyB == a);
  });
}

// N: 4 pi x radius x hardness of the softer, where a round shape meets another.
double crushingOf(const ShapeDef& a, const ShapeDef& b) {
  auto curvature = [](const ShapeDef& shape) {  // 1/m
    const bool round = shape.type == ShapeType::sphere || shape.type == ShapeType::capsule ||
                       shape.type == ShapeType::cylinder || shape.type == ShapeType::cone;
    return round ? 1 / shape.radius : 0.0;
  };
  const double sum = curvature(a) + curvature(b);
  return sum > 0 ? 4 * 3.14159265358979323846 * std::min(a.material.hardness, b.material.hardness) / sum : 0.0;
}

// kg. Whoever is on rails may be as heavy as the world to one who is not.
double effectiveMass(const BodyMass& a, const BodyMass& b) {
  const bool railsA = a.locks & kAllWays, railsB = b.locks & kAllWays;
  const double byA = railsA && !railsB ? 0 : a.invMass, byB = railsB && !railsA ? 0 : b.invMass;
  return byA + byB > 0 ? 1 / (byA + byB) : 1 / (a.invMass + b.invMass);
}

void takeConstants(Contact& c, const ShapeSet& shapes, const BodySet& bodies) {
  const Material &a = shapes.data[c.shapeA].def.material, &b = shapes.data[c.shapeB].def.material;
  c.friction = float(mixFriction(a, b));
  c.restitution = float(mixRestitution(a, b));
  c.edited = false;
  if (const PairEdit* edit = shapes.editOf(c.shapeA, c.shapeB)) {
    c.edited = edit->friction != c.friction || edit->restitution != c.restitution;
    c.friction = edit->friction;
    c.restitution = edit->restitution;
  }
  c.rolling = float(std::max(a.rollingResistance, b.rollingResistance));
  c.rollingRadius = float(rollingRadius(shapes.data[c.shapeA].def, shapes.data[c.shapeB].def));
  c.crushing = float(crushingOf(shapes.data[c.shapeA].def, shapes.data[c.shapeB].def));
  c.effectiveMass = float(effectiveMass(bodies.mass[c.bodyA], bodies.mass[c.bodyB]));
}

void ContactSet::renewConstants(BodyIndex body, const ShapeSet& shapes, const BodySet& bodies) {
  auto renew = [&](const Link& link) {
    if (link.names(body)) takeConstants(contacts[link.index], shapes, bodies);
  };
  eachAwake(renew);
  eachAsleep(renew);
}

ContactIndex ContactSet::create() {
  changed = true;
  if (!free_.empty()) {
    ContactIndex contact = free_.back();
    free_.pop_back();
    contacts[contact] = {};
    geometry[contact] = {};
    return contact;
  }
  contacts.emplace_back();
  geometry.emplace_back();
  return ContactIndex(contacts.size() - 1);
}

void ContactSet::destroy(ContactIndex contact) {
  changed = true;
  contacts[contact].count = 0;
  touchingChanged = touchingChanged || contacts[contact].touching || contacts[contact].struck;
  contacts[contact].touching = contacts[contact].struck = false;
  contacts[contact].bodyA = kNoIndex;
  free_.push_back(contact);
}

void ContactSet::insert(const std::vector<CandidatePair>& found) {
  moved_.clear();
  for (const CandidatePair& pair : found)
    if (!std::binary_search(pairs.begin(), pairs.end(), pair)) moved_.push_back(pair);
  mergeInto(pairs, moved_);
}

// From the back, in place: std::inplace_merge takes memory.
void ContactSet::mergeInto(std::vector<CandidatePair>& sorted, const std::vector<CandidatePair>& more) {
  if (more.empty()) return;
  std::size_t left = sorted.size(), right = more.size(), to = left + right;
  sorted.resize(to);
  while (right > 0) {
    bool fromLeft = left > 0 && more[right - 1] < sorted[left - 1];
    sorted[--to] = fromLeft ? sorted[--left] : more[--right];
  }
}

void ContactSet::keepRoom(std::size_t shapes) {
  // A shape in a heap has some eight neighbours within the margins (twelve and more in one on hills), a brick in a wall six.
  constexpr std::size_t kPairs = 24, kContacts = 8;
  brickfall::keepRoom(pairs, kPairs * shapes);
  std::size_t all = std::max(pairs.capacity(), asleep.capacity());  // all of them may fall asleep or wake at once
  for (auto* list : {&pairs, &asleep, &moved_}) list->reserve(all);
  brickfall::keepRoom(contacts, kContacts * shapes);
  brickfall::keepRoom(struck, kContacts * shapes);
  geometry.reserve(contacts.capacity());
  free_.reserve(contacts.capacity());
}

}  // namespace brickfall
