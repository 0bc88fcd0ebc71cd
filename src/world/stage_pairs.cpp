// Broad phase: bounds of what moved, and new candidate pairs.
#include <algorithm>

#include "world/world_impl.h"

namespace brickfall {

namespace {

//! inner radii | too small: bounds are made anew in most steps of a slow body
//! | too large: more candidate pairs that never touch
constexpr double kKeptSlack = 0.3;  // of a shape's inner radius: kept bounds are this much larger than they need be
//! m | with kKeptSlack
constexpr double kLargestSlack = 0.02;  // m

}  // namespace

double World::Impl::marginOf(ShapeIndex shape) const {
  return std::min(def.solver.contactMargin, 0.3 * shapes.data[shape].innerRadius);
}

double World::Impl::slackOf(ShapeIndex shape) const {
  return std::min(kLargestSlack, kKeptSlack * shapes.data[shape].innerRadius);
}

// Bounds that anything must meet to be able to touch the shape in the coming step: its motion at the present velocity,
// and the contact margin. Contacts are made only where these overlap, so that which exist does not depend on the
// history of the tree.
void World::Impl::updateSwept(ShapeIndex shape, double dt) {
  ShapeData& s = shapes.data[shape];
  const BodyMotion& m = bodies.motion[s.body];
  Aabb box = bounds(s.geometry, shapes.worldPose(shape, bodies));
  if (s.geometry.type != ShapeType::plane) {
    Vec3 move = m.linearVelocity * dt;
    double turn = std::min(1.0, length(m.angularVelocity) * dt) * bodies.mass[s.body].outerRadius;
    double pad = marginOf(shape) + turn;
    box = {box.lower + min(move, Vec3{}) - Vec3{pad, pad, pad}, box.upper + max(move, Vec3{}) + Vec3{pad, pad, pad}};
  }
  s.swept = box;
}

void World::Impl::addProxy(ShapeIndex shape) {
  updateSwept(shape, 0);
  addProxy(shape, shapes.data[shape].swept);
}

void World::Impl::addProxy(ShapeIndex shape, const Aabb& swept) {
  ShapeData& s = shapes.data[shape];
  s.proxy = broadPhase->add(swept, slackOf(shape), shape);
}

void World::Impl::findPairs() {
  StageTimer timer(report, Stage::pairs);
  auto update = [&](BodyIndex body) {
    if (bodies.still[body]) return;
    for (ShapeIndex shape : bodies.shapes[body]) {
      updateSwept(shape, context.dt);
      const ShapeData& s = shapes.data[shape];
      broadPhase->update(s.proxy, s.swept, slackOf(shape));
    }
  };
  for (BodyIndex body : awake) update(body);
  for (BodyIndex body : moving) update(body);

  auto wanted = [&](std::uint32_t a, std::uint32_t b) {
    BodyIndex bodyA = shapes.data[a].body, bodyB = shapes.data[b].body;
    if (bodyA == bodyB) return false;
    if (bodies.data[bodyA].type != BodyType::dynamic && bodies.data[bodyB].type != BodyType::dynamic) return false;
    return filtersAllow(shapes.data[a].def.filter, shapes.data[b].def.filter);
  };
  foundPairs.clear();
  broadPhase->newPairs(wanted, foundPairs);
  newPairs.clear();
  for (const auto& [a, b] : foundPairs) {
    CandidatePair pair{a, b, shapes.data[a].body, shapes.data[b].body, kNoIndex, 0};
    // A pair that sleeps waits in the other list; it wakes with its island.
    bool known = std::binary_search(contacts.asleep.begin(), contacts.asleep.end(), pair);
    if (!known) newPairs.push_back(pair);
  }
  contacts.insert(newPairs);
}

}  // namespace brickfall
