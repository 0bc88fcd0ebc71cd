// One body on something fixed whose contacts go on through the step: Verlet's method. With a the acceleration of this step, a0 that of
// the last and h0 its length, the velocity at the start is corrected by (a - a0) h0 / 2, the mean of both forces; the way is
// (v + a h / 2) h and the new velocity v + a h. A slide, whose forces do not change, comes out exact; what rocks or topples keeps its
// energy, which the mean of velocities alone would feed. From rest, after flight and after an impact there is no a0, and no correction.
// Bodies that push each other are left alone (what one gains, the other would have to give), but where they slide as one:
// finish/group_slide.h.
#include "solver/finish/lone_body.h"

#include <cmath>

#include "solver/finish/steady.h"

namespace brickfall {

namespace {

//! - | too small: the last step of a slide is too long | too large: what goes on slowly counts as stopped
constexpr double kStopped = 1e-3;  // of the speed at the start of the step
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

// By how much the mean of this step's forces and the last one's changes the velocity at the start; nothing where they differ by more
// than they are: something has hit.
VelocityChange towardsMean(const SteadyChange& last, const SteadyChange& now, double radius) {
  auto size = [&](Vec3 linear, Vec3 angular) { return length(linear) + radius * length(angular); };
  const Vec3 linear = now.linear - last.linear, angular = now.angular - last.angular;
  if (!(size(linear, angular) <= size(last.linear, last.angular))) return {};
  return {linear * (0.5 * last.dt), angular * (0.5 * last.dt)};
}

}  // namespace

void finishLoneBody(const Island& island, Ties ties, StepContext& context) {
  if (island.bodies.size() != 1 || island.groups.flies(0) || island.facts.partnersMove) return;
  const BodyIndex body = island.bodies[0];
  const VelocityChange change = changeOf(body, context);
  if (!steadyContacts(island, context, change)) return;
  const double h = island.dt;
  const SteadyChange now{change.move * (1 / h), change.turn * (1 / h), h};
  const VelocityChange mean = towardsMean(context.bodies->data[body].steady, now, context.bodies->mass[body].outerRadius);
  const double back = 0.5 * partUntilStopped(island, ties, context, change.move);
  shift(body, mean.move * h - change.move * (back * h), mean.turn * h - change.turn * (back * h), context);
  accelerate(body, mean.move, context.bodies->worldInertia(body) * mean.turn, context);
  rememberSteady(body, now, context);
}

}  // namespace brickfall
