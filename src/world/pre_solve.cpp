#include "world/pre_solve.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "brickfall/limits.h"
#include "dynamics/ties.h"
#include "world/registry.h"
#include "world/upkeep.h"

namespace brickfall {

namespace {

PreSolveContact shown(const Contact& c, const ContactGeometry& g, const Registry& registry) {
  const BodyMotion &a = registry.bodies.motion[c.bodyA], &b = registry.bodies.motion[c.bodyB];
  const auto nearest = std::min_element(c.points.gap, c.points.gap + c.count) - c.points.gap;
  PreSolveContact out;
  out.bodyA = registry.idOf(c.bodyA);
  out.bodyB = registry.idOf(c.bodyB);
  out.shapeA = registry.idOfShape(c.shapeA);
  out.shapeB = registry.idOfShape(c.shapeB);
  out.normalWorld = a.orientation * g.normal;
  out.pointWorld = a.position + a.orientation * g.anchorA[nearest];
  out.velocityWorld = velocityAgainst(a, b, out.pointWorld - a.position, out.pointWorld - b.position);
  out.separation = double(c.points.gap[nearest]);
  out.friction = double(c.friction);
  out.restitution = double(c.restitution);
  return out;
}

float within(double value, double most, float was) {
  return std::isnan(value) ? was : float(std::clamp(value, 0.0, most));
}

// Asks about one contact and changes it. Several of one pair of shapes (on a mesh) follow each other: the pair is off
// if all of them are. Returns whether anything is other than in the last step.
bool ask(const World::PreSolve& callback, CandidatePair& pair, ContactSet& contacts, Registry& registry) {
  Contact& c = contacts.contacts[pair.contact];
  Contact fresh = c;
  takeConstants(fresh, registry.shapes, registry.bodies);
  PreSolveContact shows = shown(fresh, contacts.geometry[pair.contact], registry);
  callback(shows);
  const float friction = within(shows.friction, limits::kLargestFriction, fresh.friction);
  const float restitution = within(shows.restitution, 1, fresh.restitution);
  // One that was off before is found anew in each part.
  const bool differs = shows.enabled ? friction != c.friction || restitution != c.restitution : !c.born;
  c.friction = friction;
  c.restitution = restitution;
  c.edited = friction != fresh.friction || restitution != fresh.restitution;
  std::vector<PairEdit>& edits = registry.shapes.edits;
  const bool goesOn = !edits.empty() && edits.back().shapeA == pair.shapeA && edits.back().shapeB == pair.shapeB;
  const bool enabled = shows.enabled || (goesOn && edits.back().enabled);
  if (goesOn) edits.pop_back();
  edits.push_back({pair.shapeA, pair.shapeB, friction, restitution, enabled});
  if (shows.enabled) return differs;
  contacts.destroy(pair.contact);
  pair.contact = kNoIndex;
  return differs;
}

}  // namespace

void askPreSolve(const World::PreSolve& callback, Registry& registry, Ties& ties, Upkeep upkeep) {
  ContactSet& contacts = ties.contacts;
  registry.shapes.edits.clear();
  std::vector<BodyIndex> changed;
  for (CandidatePair& pair : contacts.pairs)
    if (pair.contact != kNoIndex && ask(callback, pair, contacts, registry))
      changed.insert(changed.end(), {pair.bodyA, pair.bodyB});
  std::erase_if(contacts.pairs, [](const CandidatePair& pair) { return pair.part > 0 && pair.contact == kNoIndex; });
  for (BodyIndex body : changed)
    if (registry.bodies.data[body].type == BodyType::dynamic) upkeep.disturb(body);
}

}  // namespace brickfall
