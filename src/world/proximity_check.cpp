// Invariants of pairs and contacts, and of the bounds that shapes are kept in.
#include <algorithm>
#include <cmath>

#include "solver/step_context.h"
#include "world/proximity.h"

namespace brickfall {

namespace {

bool dynamic(const BodySet& bodies, BodyIndex body) { return bodies.data[body].type == BodyType::dynamic; }

bool namesWhatIsThere(const CandidatePair& p, const Registry& r, const ContactSet& contacts) {
  auto fine = [&](ShapeIndex shape, BodyIndex body) {
    return r.shapes.alive(shape) && r.shapes.data[shape].body == body && r.bodies.alive(body) &&
           !r.bodies.data[body].quarantined;
  };
  return fine(p.shapeA, p.bodyA) && fine(p.shapeB, p.bodyB) &&
         (p.contact == kNoIndex || p.contact < contacts.contacts.size());
}

// A contact's facts about its shapes, and its frame.
void checkContact(Findings& f, const Registry& r, const Contact& c, const ContactGeometry& g) {
  const Material &a = r.shapes.data[c.shapeA].def.material, &b = r.shapes.data[c.shapeB].def.material;
  double inverseMass = r.bodies.mass[c.bodyA].invMass + r.bodies.mass[c.bodyB].invMass;
  f.expect(c.friction == float(mixFriction(a, b)) && c.restitution == float(mixRestitution(a, b)) &&
               c.effectiveMass == float(1 / inverseMass),
           "contacts: a constant is not that of its bodies");
  f.expect(std::fabs(lengthSquared(g.normal) - 1) < 1e-6 && std::fabs(lengthSquared(g.tangent1) - 1) < 1e-6 &&
               std::fabs(dot(g.normal, g.tangent1)) < 1e-6,
           "contacts: a frame is not orthonormal");
  f.expect(isSound(c.points), "contacts: what points remember is out of range");
}

// Sleeping pairs name no body that is awake or moves.
void checkPairs(Findings& f, const Registry& r, const ContactSet& c) {
  std::vector<bool> used(c.contacts.size(), false);
  for (const auto* list : {&c.pairs, &c.asleep})
    for (const CandidatePair& p : *list) {
      f.expect(p.shapeA < p.shapeB && p.bodyA != p.bodyB && (dynamic(r.bodies, p.bodyA) || dynamic(r.bodies, p.bodyB)),
               "pairs: shapes that can't meet");
      bool mesh =
          r.shapes.data[p.shapeA].def.type == ShapeType::mesh || r.shapes.data[p.shapeB].def.type == ShapeType::mesh;
      f.expect(p.part == 0 || mesh, "pairs: a part of what is no mesh");
      if (p.contact == kNoIndex) continue;
      f.expect(!used[p.contact], "pairs: two have the same contact");
      used[p.contact] = true;
      checkContact(f, r, c.contacts[p.contact], c.geometry[p.contact]);
    }
  checkFreeSlots(f, c.unused(), c.contacts.size(), [&](std::size_t i) { return !used[i]; });
  for (std::size_t i = 0; i < c.contacts.size(); i++)
    f.expect((c.contacts[i].count > 0) == used[i], "contacts: one with points is of no pair");
  for (const CandidatePair& p : c.asleep) {
    f.expect(!std::binary_search(c.pairs.begin(), c.pairs.end(), p), "pairs: one is both awake and asleep");
    for (BodyIndex body : {p.bodyA, p.bodyB})
      f.expect(r.bodies.data[body].activity != BodyActivity::awake && !r.bodies.isDriven(body),
               "pairs: one asleep names a body that is not");
  }
}

}  // namespace

void Proximity::checkStructure(Findings& f, const Registry& registry) const {
  f.expect(contacts.contacts.size() == contacts.geometry.size(), "contacts: lists of different lengths");
  f.expect(around.size() == registry.shapes.slots(), "bounds: not one for each shape");
  if (f.any()) return;
  for (const auto* list : {&contacts.pairs, &contacts.asleep}) {
    f.expect(isAscending(*list), "pairs: not sorted, or twice");
    for (const CandidatePair& p : *list) {
      bool fine = namesWhatIsThere(p, registry, contacts);
      f.expect(fine, "pairs: one names what is not there");
      f.expect(p.part < std::uint32_t(kMaxMeshManifolds) && (p.part == 0 || p.contact != kNoIndex),
               "pairs: a part too many, or without a contact");
      if (!fine || p.contact == kNoIndex) continue;
      const Contact& c = contacts.contacts[p.contact];
      f.expect(c.shapeA == p.shapeA && c.shapeB == p.shapeB && c.bodyA == p.bodyA && c.bodyB == p.bodyB,
               "pairs: the contact is another pair's");
      f.expect(c.count >= 1 && c.count <= 4, "contacts: a number of points that is not 1 .. 4");
    }
  }
  for (ContactIndex c : contacts.unused())
    f.expect(c < contacts.contacts.size(), "contacts: a free one that is not there");
}

void Proximity::check(Findings& f, const Registry& registry) const { checkPairs(f, registry, contacts); }

void Proximity::checkBounds(Findings& f, const Registry& registry) const {
  for (const std::string& text : broadPhase->validate()) f.expect(false, "broad phase: " + text);
  for (BodyIndex i = 0; i < registry.bodies.slots(); i++) {
    if (!registry.bodies.alive(i)) continue;
    for (ShapeIndex s : registry.bodies.shapes[i]) {
      const Surroundings& at = around[s];
      if (at.proxy == kNoProxy) {
        f.expect(registry.bodies.data[i].quarantined, "shape", s, "not in the broad phase");
        continue;
      }
      Aabb now = bounds(registry.shapes.data[s].geometry, registry.shapes.worldPose(s, registry.bodies));
      f.expect(contains(kept(s), at.swept), "shape", s, "its swept bounds are outside the kept ones");
      f.expect(contains(kept(s), now), "shape", s, "outside its kept bounds");
    }
  }
}

}  // namespace brickfall
