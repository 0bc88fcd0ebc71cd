// Implicit Euler moves a body by its velocity at the end of the step: it slides v dt / 2 less far, and a block that starts
// to topple is dt / 2 ahead ever after. Where forces do not depend on the pose (sliding, rolling), the mean of old and new
// velocity is right to second order. Where they do (rocking, toppling), that would feed energy in; there steps are those of
// a leapfrog: positions and times of second order, energy kept, velocities half a step late. By how much velocities are
// late is remembered: not at all from rest, after flight and after an impact, and they are brought up to date before one.
// Bodies that push each other are left alone (what one gains, the other would have to give), but where they slide as one:
// finish/group_slide.h.
#include "solver/finish/lone_body.h"

#include <cmath>

#include "solver/finish/steady.h"
#include "solver/free_motion.h"

namespace brickfall {

namespace {

//! - | too small: the last step of a slide is too long | too large: what goes on slowly counts as stopped
constexpr double kStopped = 1e-3;  // of the speed at the start of the step
//! of the way | too small: slides lose half a step of way | too large: what rocks gains energy
constexpr double kTurnShare = 1e-3;  // of the way: how far a slide may turn the surface out of its plane

// All points that carry force neither land nor leave in this step, and there is one.
bool steadyContacts(const Island& island, const StepContext& context, const VelocityChange& change) {
  bool carried = false;
  for (std::size_t k = 0; k < island.rows.contacts.records.size(); k++) {
    const ContactRecord& r = island.rows.contacts.records[k];
    const Contact& c = context.contacts->contacts[island.rows.contacts.contactOf[k]];
    const VelocityChange a = r.bodyA == 0 ? change : VelocityChange{}, b = r.bodyA == 0 ? VelocityChange{} : change;
    for (int i = 0; i < c.count; i++) {
      if (!(c.points.forceN[i] > 0)) continue;
      carried = true;
      if (!isSteady(r, island.rows.contacts.starts[k], i, a, b, island.dt)) return false;
    }
  }
  return carried;
}

// Turns only within the plane of its contacts, or looks the same however it turns. `way`, `th`: by the mean of both velocities.
bool keepsItsForces(const Island& island, const StepContext& context, Vec3 way, Vec3 th) {
  BodyIndex body = island.bodies[0];
  const BodyMass& mass = context.bodies->mass[body];
  Vec3 turn = visibleTurn(mass, context.bodies->motion[body].orientation, th);
  for (const ContactRecord& r : island.rows.contacts.records) {
    Vec3 n = toDouble(r.n);
    Vec3 tilt = turn - n * dot(n, turn);
    if (!(length(tilt) * mass.outerRadius <= kTurnShare * length(way))) return false;
  }
  return true;
}

// What slides and is stopped by friction within the step slows down for a part of it only, at the full friction: that part, 1 if
// it does not stop. Its points stop where it does.
double partUntilStopped(const Island& island, Ties ties, const StepContext& context, Vec3 moveChange) {
  const BodyIndex body = island.bodies[0];
  const Vec3 start = context.free[body].startVelocity;
  const double speed = length(start), mass = context.bodies->mass[body].mass;
  if (!(speed > 0) || length(context.solved[body].velocity) > kStopped * speed) return 1;
  const Vec3 back = start * (-1 / speed);
  double limit = 0, held = 0;  // N, along `back`: of friction, and that it gave
  for (std::size_t k = 0; k < island.rows.contacts.records.size(); k++) {
    const ContactRecord& r = island.rows.contacts.records[k];
    Contact& c = ties.contacts.contacts[island.rows.contacts.contactOf[k]];
    Vec3 t1 = toDouble(r.t1), t2 = cross(toDouble(r.n), t1);
    for (int i = 0; i < c.count; i++) {
      if (!(c.points.forceN[i] > 0)) continue;
      limit += double(c.friction) * double(c.points.forceN[i]);
      Vec3 friction = t1 * double(c.points.force1[i]) + t2 * double(c.points.force2[i]);
      held += dot(friction, back) * (r.bodyA == 0 ? -1 : 1);
      c.points.stickingMask &= ~(1u << i);  // its anchor is to be where it stops
    }
  }
  double slowing = dot(moveChange, back) * mass / island.dt, others = slowing - held;
  return limit + others > slowing ? slowing / (limit + others) : 1;
}

}  // namespace

void correctLoneBody(Island& island, Ties ties, StepContext& context) {
  if (island.resting() || island.facts.partnersMove || island.bodies.size() != 1) return;
  BodyIndex body = island.bodies[0];
  const FreeMotion& free = context.free[body];
  SolvedMotion& s = context.solved[body];
  const VelocityChange change = changeOf(body, context);
  const auto& [moveChange, turnChange] = change;
  if (!steadyContacts(island, context, change)) return;
  bool fromRest = free.startVelocity == Vec3{} && free.startSpin == Vec3{};
  bool steadyForces = keepsItsForces(island, context, s.d - moveChange * (0.5 * island.dt),
                                     s.freeTurn ? s.th : s.th - turnChange * (0.5 * island.dt));
  bool inStep = steadyForces || island.toImpact();
  // In steps, from the moment to which the velocities at the start belong: to the middle of this step, to its end.
  double late = context.bodies->data[body].lag / island.dt;
  if (late < 0) late = 0.5;  // as after implicit steps
  // What slides or rolls was in step all along, whatever it did before.
  if (fromRest || (steadyForces && !island.toImpact())) late = 0;
  double middle = late + 0.5, end = middle;
  if (inStep) end = late + 1;
  if (steadyForces) middle += 0.5 * (1 - partUntilStopped(island, ties, context, moveChange));
  s.d += moveChange * ((middle - 1) * island.dt);
  if (!s.freeTurn) s.th += turnChange * ((middle - 1) * island.dt);
  s.velocity += moveChange * (end - 1);
  s.angularMomentum += context.bodies->worldInertia(body) * turnChange * (end - 1);
  s.lag = inStep ? 0 : 0.5 * island.dt;
  island.leapt = true;
}

}  // namespace brickfall
