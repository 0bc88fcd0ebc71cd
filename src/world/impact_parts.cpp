#include "world/impact_parts.h"

#include <algorithm>

#include "solver/free_motion.h"
#include "solver/impact.h"
#include "solver/joint/spins.h"
#include "world/core_sweep.h"

namespace brickfall {

namespace {

//! - | too small: impacts of larger islands are first order in the time step
//! | too large: cost, impacts that are not solved well
constexpr std::size_t kMostBodies = 5;

// Contacts of these shapes are true from afar: a shape that moves without a turn cannot pass the other one unseen.
bool isFoundExactly(ShapeType a, ShapeType b) {
  if (a == ShapeType::plane || b == ShapeType::plane) return true;
  return (isRound(a) && (isRound(b) || b == ShapeType::box)) || (isRound(b) && a == ShapeType::box);
}

}  // namespace

bool ImpactParts::mayBeCut(const Island& island) const {
  const BodySet& bodies = registry_.bodies;
  auto carries = [&](BodyIndex body) { return bodies.carries(body); };
  if (island.bodies.size() > kMostBodies && !passesBlowsOn(island)) return false;
  if (std::any_of(island.partners.begin(), island.partners.end(), carries)) return false;
  const bool alone = island.bodies.size() == 1;
  // Without a turn a way of any length may be parted.
  if (alone && length(turnOf(island.bodies[0])) < kTrifle && foundExactly(island)) return true;
  return std::all_of(island.bodies.begin(), island.bodies.end(), [&](BodyIndex body) {
    return length(bodies.motion[body].linearVelocity) * context_.dt <= kFarWay * bodies.mass[body].outerRadius;
  });
}

// A row of bodies that nothing presses passes a blow from one to the next. The larger the restitution is, the less of
// it each impact loses, and the more bodies it reaches.
bool ImpactParts::passesBlowsOn(const Island& island) const {
  const std::size_t count = island.bodies.size();
  if (count > std::size_t(kMostParts)) return false;
  float most = 0;
  bool pressed = false;
  island.rows.eachManifold([&](ContactIndex contact) {
    const Contact& c = context_.ties->contacts.contacts[contact];
    most = std::max(most, c.restitution);
    pressed = pressed || c.touching;
  });
  return !pressed && double(count) * (1 - double(most)) <= double(kMostBodies);
}

double ImpactParts::longest(const Island& island) const {
  double speed = island.bodies.size() <= kMostBodies ? jointedSpin(island, context_) : 0;
  if (island.bodies.size() == 1 && !touchesNothing(island, context_))
    speed = std::max(speed, length(turnOf(island.bodies[0])) / context_.dt);
  return std::max(context_.dt / kMostParts, kMostTurn / std::max(speed, 1e-9));
}

bool ImpactParts::foundExactly(const Island& island) const {
  bool all = true;
  island.rows.eachManifold([&](ContactIndex contact) {
    const Contact& c = context_.ties->contacts.contacts[contact];
    const auto& shapes = registry_.shapes.data;
    all = all && isFoundExactly(shapes[c.shapeA].geometry.type, shapes[c.shapeB].geometry.type);
  });
  return all;
}

// Visible turn (rad) in a step at the present spin.
Vec3 ImpactParts::turnOf(BodyIndex body) const {
  const BodyMotion& m = registry_.bodies.motion[body];
  return visibleTurn(registry_.bodies.mass[body], m.orientation, m.angularVelocity) * context_.dt;
}

bool ImpactParts::runThrough(const Island& island, double dt, const Proximity& proximity) const {
  const BodySet& bodies = registry_.bodies;
  auto isDynamic = [&](BodyIndex body) { return bodies.data[body].type == BodyType::dynamic; };
  // Others may be at another moment of their step: they are looked for where they are at that of the island.
  auto leftOf = [&](BodyIndex body) { return context_.ahead[body].left; };
  const double left = leftOf(island.bodies[0]);
  auto wayOf = [&](BodyIndex body) {
    if (std::binary_search(island.bodies.begin(), island.bodies.end(), body))
      return sweepOf(bodies, body, context_.solved[body].d, context_.solved[body].th);
    const BodyMotion& m = bodies.motion[body];
    Sweep way = sweepOf(bodies, body, m.linearVelocity * dt, m.angularVelocity * dt);
    way.start.position += m.linearVelocity * (leftOf(body) - left) * context_.dt;
    return way;
  };
  auto meets = [&](ShapeIndex shape, const Sweep& own) {
    const ShapeData& s = registry_.shapes.data[shape];
    bool met = false;
    proximity.broadPhase->query(sweptBounds(s, own), [&](std::uint32_t other) {
      const ShapeData& o = registry_.shapes.data[other];
      if (o.body == s.body || !registry_.shapes.mayTouch(shape, other)) return true;
      if (!context_.ties->mayCollide(s.body, o.body)) return true;
      Sweep of = wayOf(o.body);
      met = coreWay(s, own, o, of) < 1 || (isDynamic(o.body) && coreWay(o, of, s, own) < 1);
      return !met;
    });
    return met;
  };
  for (BodyIndex body : island.bodies) {
    Sweep own = wayOf(body);
    if (!own.turns && length(own.way) < kCoreShare * bodies.mass[body].innerRadius) continue;
    for (ShapeIndex shape : bodies.shapes[body])
      if (meets(shape, own)) return true;
  }
  return false;
}

}  // namespace brickfall
