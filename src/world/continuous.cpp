// What the contacts of a step can't see: they are found along the velocities before it, with normals and arms that stay
// as they are. A body that a hit throws somewhere else, or spins through most of a turn, or that a force accelerates from
// rest, could end the step behind something thin. So the core of every fast body, a ball a fourth as thick as its shape, is
// swept along the way that the solve found, against the ways of the others, and the body stops for this step where its core
// would enter something. A body that contacts would spin too far in one step goes only a part of its way and turn, as
// far as frozen arms are true. Velocities stay: the next step finds the contact and does the rest.
#include <algorithm>
#include <cmath>

#include "geometry/queries.h"
#include "solver/free_motion.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

constexpr double kCoreShare = 0.25;  // of a shape's inner radius

}  // namespace

// Way of a body in this step.
Vec3 World::Impl::wayOf(BodyIndex body) const {
  const BodyData& data = bodies.data[body];
  if (data.type == BodyType::kinematic) return bodies.motion[body].linearVelocity * context.dt;
  if (data.type == BodyType::fixed || data.activity != BodyActivity::awake || context.solved[body].rest) return {};
  return context.solved[body].d;
}

void World::Impl::stopAtObstacles(BodyIndex body) {
  SolvedMotion& s = context.solved[body];
  if (s.rest) return;
  double turn = length(visibleTurn(bodies.mass[body], bodies.motion[body].orientation, s.th));
  if (turn > kLargestTurn && !s.freeTurn) {
    s.d *= kLargestTurn / turn;
    s.th *= kLargestTurn / turn;
  }
  double thickness = bodies.mass[body].innerRadius * (turn < kLargestTurn ? 1 : 0.5);
  if (!(lengthSquared(s.d) > thickness * thickness) || !isFinite(s.d)) return;
  double share = 1;
  for (ShapeIndex shape : bodies.shapes[body]) share = std::min(share, freeWay(shape, s.d));
  s.d *= share;
}

// Share of its body's way d that the core of a shape can go.
double World::Impl::freeWay(ShapeIndex shape, Vec3 d) const {
  const ShapeData& s = shapes.data[shape];
  Shape core;
  core.type = ShapeType::sphere;
  core.radius = kCoreShare * s.innerRadius;
  Vec3 at = transformPoint(bodies.pose(s.body), s.middle);
  Vec3 reach{core.radius, core.radius, core.radius};
  double share = 1;
  broadPhase.query({min(at, at + d) - reach, max(at, at + d) + reach}, [&](std::uint32_t other) {
    const ShapeData& o = shapes.data[other];
    if (o.body == s.body || !filtersAllow(s.def.filter, o.def.filter)) return true;
    Transform pose = shapes.worldPose(other, bodies), back = inverse(pose);
    Transform coreInOther{transformPoint(back, at), {}};
    Vec3 motion = rotate(back.rotation, d - wayOf(o.body));
    // However often it is stopped there, it never gets all the way.
    double apart = shapeDistance(o.geometry, core, coreInOther).distance;
    if (!(apart > 0)) return true;  // inside from the start: the contacts push it out
    std::optional<double> met = timeOfImpact(o.geometry, core, coreInOther, motion, std::min(core.radius, 0.5 * apart));
    if (met) share = std::min(share, *met);
    return true;
  });
  return share;
}

}  // namespace brickfall
