// Invariants of candidate pairs and their contacts.
#include <algorithm>
#include <cmath>
#include <vector>

#include "brickfall/limits.h"
#include "dynamics/contact_set.h"
#include "dynamics/shape_set.h"
#include "narrowphase/mesh_collide.h"

namespace brickfall {

namespace {

//! not of the method: what a snapshot may say
constexpr double kFarthestAnchor = 1e9;  // m

bool isPlace(Vec3 v) {
  return std::fabs(v.x) <= kFarthestAnchor && std::fabs(v.y) <= kFarthestAnchor && std::fabs(v.z) <= kFarthestAnchor;
}

bool isSound(const ContactGeometry& g) {
  const Quat q = g.relativeRotation;
  bool fine = std::fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-9 && isPlace(g.relativePosition) &&
              isPlace(g.centre);
  for (int i = 0; i < 4; i++) fine = fine && isPlace(g.anchorA[i]) && isPlace(g.anchorB[i]);
  return fine;
}

bool isDynamic(const BodySet& bodies, BodyIndex body) { return bodies.data[body].type == BodyType::dynamic; }

bool namesWhatIsThere(const CandidatePair& p, const BodySet& bodies, const ShapeSet& shapes,
                      const ContactSet& contacts) {
  auto fine = [&](ShapeIndex shape, BodyIndex body) {
    return shapes.alive(shape) && shapes.data[shape].body == body && bodies.alive(body) && bodies.takesPart(body);
  };
  return fine(p.shapeA, p.bodyA) && fine(p.shapeB, p.bodyB) &&
         (p.contact == kNoIndex || p.contact < contacts.contacts.size());
}

// A contact's facts about its shapes, and its frame.
void checkContact(Findings& f, const BodySet& bodies, const ShapeSet& shapes, const Contact& c,
                  const ContactGeometry& g) {
  const Material &a = shapes.data[c.shapeA].def.material, &b = shapes.data[c.shapeB].def.material;
  const bool own = c.friction == float(mixFriction(a, b)) && c.restitution == float(mixRestitution(a, b));
  const bool given =
      c.friction >= 0 && c.friction <= float(limits::kLargestFriction) && c.restitution >= 0 && c.restitution <= 1;
  f.expect((c.edited ? given : own) && c.rolling == float(std::max(a.rollingResistance, b.rollingResistance)) &&
               c.rollingRadius == float(rollingRadius(shapes.data[c.shapeA].def, shapes.data[c.shapeB].def)) &&
               c.crushing == float(crushingOf(shapes.data[c.shapeA].def, shapes.data[c.shapeB].def)) &&
               c.effectiveMass == float(effectiveMass(bodies.mass[c.bodyA], bodies.mass[c.bodyB])),
           "contacts: a constant is not that of its bodies");
  f.expect(std::fabs(lengthSquared(g.normal) - 1) < 1e-6 && std::fabs(lengthSquared(g.tangent1) - 1) < 1e-6 &&
               std::fabs(dot(g.normal, g.tangent1)) < 1e-6,
           "contacts: a frame is not orthonormal");
  f.expect(isSound(c.points), "contacts: what points remember is out of range");
}

// Sleeping pairs name no body that is awake or moves.
void checkPairs(Findings& f, const BodySet& bodies, const ShapeSet& shapes, const ContactSet& c) {
  std::vector<bool> used(c.contacts.size(), false);
  for (const auto* list : {&c.pairs, &c.asleep})
    for (const CandidatePair& p : *list) {
      f.expect(p.shapeA < p.shapeB && p.bodyA != p.bodyB && (isDynamic(bodies, p.bodyA) || isDynamic(bodies, p.bodyB)),
               "pairs: shapes that can't meet");
      bool mesh =
          shapes.data[p.shapeA].def.type == ShapeType::mesh || shapes.data[p.shapeB].def.type == ShapeType::mesh;
      f.expect(p.part == 0 || mesh, "pairs: a part of what is no mesh");
      if (p.contact == kNoIndex) continue;
      f.expect(!used[p.contact], "pairs: two have the same contact");
      used[p.contact] = true;
      checkContact(f, bodies, shapes, c.contacts[p.contact], c.geometry[p.contact]);
    }
  checkFreeSlots(f, c.unused(), c.contacts.size(), [&](std::size_t i) { return !used[i]; });
  for (std::size_t i = 0; i < c.contacts.size(); i++)
    f.expect((c.contacts[i].count > 0) == used[i], "contacts: one with points is of no pair");
  for (const CandidatePair& p : c.asleep) {
    f.expect(!std::binary_search(c.pairs.begin(), c.pairs.end(), p), "pairs: one is both awake and asleep");
    for (BodyIndex body : {p.bodyA, p.bodyB})
      f.expect(bodies.data[body].activity != BodyActivity::awake && !bodies.isDriven(body),
               "pairs: one asleep names a body that is not");
  }
}

}  // namespace

void ContactSet::checkStructure(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const {
  f.expect(contacts.size() == geometry.size(), "contacts: lists of different lengths");
  if (f.any()) return;
  for (const auto* list : {&pairs, &asleep}) {
    f.expect(isAscending(*list), "pairs: not sorted, or twice");
    for (const CandidatePair& p : *list) {
      bool fine = namesWhatIsThere(p, bodies, shapes, *this);
      f.expect(fine, "pairs: one names what is not there");
      f.expect(p.part < std::uint32_t(kMaxMeshManifolds) && (p.part == 0 || p.contact != kNoIndex),
               "pairs: a part too many, or without a contact");
      if (!fine || p.contact == kNoIndex) continue;
      const Contact& c = contacts[p.contact];
      f.expect(c.shapeA == p.shapeA && c.shapeB == p.shapeB && c.bodyA == p.bodyA && c.bodyB == p.bodyB,
               "pairs: the contact is another pair's");
      f.expect(c.count >= 1 && c.count <= 4, "contacts: a number of points that is not 1 .. 4");
    }
  }
  for (ContactIndex c : unused()) f.expect(c < contacts.size(), "contacts: a free one that is not there");
}

void ContactSet::check(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const {
  checkPairs(f, bodies, shapes, *this);
  std::vector<bool> listed(contacts.size(), false);
  for (ContactIndex contact : struck)
    if (contact < listed.size()) listed[contact] = true;
  for (std::size_t i = 0; i < contacts.size(); i++)
    f.expect(!contacts[i].struck || listed[i],
             "a contact that was struck is not listed: its hit would be told for ever");
}

void ContactSet::checkRanges(Findings& f) const {
  for (ContactIndex contact : struck) f.expect(contact < contacts.size(), "a contact that was struck is not there");
  for (std::size_t i = 0; i < contacts.size(); i++) {
    if (contacts[i].count == 0) continue;
    f.expect(isSound(contacts[i].points), "what a contact remembers is out of range");
    f.expect(isSound(geometry[i]), "a contact's geometry is out of range");
  }
}

}  // namespace brickfall
