// One body on something fixed, or on a surface that runs, whose contacts go on through the step: the leapfrog, as
// Verlet wrote it (docs/step.md). Bodies that push each other are left alone (what one gains the other would have to
// give), unless they slide as one: finish/rigid_groups.cpp.
#include "solver/finish/finish.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "solver/finish/motion.h"

namespace brickfall {

namespace {

EndChanges ofRow(RowEnds ends, const VelocityChange& body) {
  return ends.a == 0 ? EndChanges{body, {}} : EndChanges{{}, body};
}

// All points that carry force neither land nor leave in this step, and there is one.
bool steadyContacts(const Island& island, const StepContext& context, const VelocityChange& change) {
  bool carried = false, steady = true;
  const StepSpan span{island.dt, context.bodies->data[island.bodies[0]].steady.dt, true};
  island.rows.each([&](const auto& kind, std::size_t k) {
    if (!steady) return;
    const RowCourse course = kind.courseOf(k, ofRow(kind.ends(k), change), span, context);
    carried = carried || course != RowCourse::idle;
    steady = course != RowCourse::changes;
  });
  return carried && steady;
}

//! of the larger change | too small: rocking bodies lose half a step as forces change; slender blocks topple late
//! | too large: a velocity changed by a hit or a start counts as a force that goes on
constexpr double kSameForces = 0.4;  // changes of velocity that differ by no more come from the same forces

// m/s: of the surfaces that the body may touch, if they run alike.
std::optional<Vec3> runUnder(const Island& island, const BodySet& bodies) {
  std::optional<Vec3> run;
  for (BodyIndex partner : island.partners) {
    const Vec3 own = bodies.surfaceVelocity(partner);
    if (run && !(*run == own)) return std::nullopt;
    run = own;
  }
  return run;
}

// Share of the step for which a sliding body slows down, from its true velocity and at the full friction. It is 1 if
// friction does not stop the body within the step. Its points stop where it does.
// Speeds are those against the surface that runs at `run`.
double partUntilStopped(const Island& island, const StepContext& context, const VelocityChange& change, Vec3 run) {
  const BodyIndex body = island.bodies[0];
  const Vec3 start = context.free[body].startVelocity - run, solved = context.solved[body].velocity - run;
  const double speed = length(start), mass = context.bodies->mass[body].mass, h = island.dt;
  // What spins in its place does not slide.
  if (!(speed > kTrifle * length(context.free[body].startSpin) * context.bodies->mass[body].outerRadius)) return 1;
  const Vec3 back = start * (-1 / speed);
  const double late = 0.5 * context.bodies->data[body].steady.dt / h;
  const bool turnsBack = dot(solved + change.move * late, back) > 0;
  if (!turnsBack && length(solved) > kTrifle * length(start - context.free[body].late)) return 1;
  const VelocityChange moves{start, context.free[body].startSpin};
  FrictionAlong friction;  // along `back`
  island.rows.each([&](const auto& kind, std::size_t k) {
    kind.addFriction(k, back, kind.ends(k).a != 0, moves, context, friction);
  });
  // What rocks does not slide, either: its points stand while it goes on.
  if (-friction.goes < 0.5 * friction.limit * speed) return 1;
  const double others = dot(change.move, back) * mass / h - friction.given, slowing = speed * mass / h;
  return friction.limit + others > slowing ? slowing / (friction.limit + others) : 1;
}

// In steps like this one: for how long what slid goes on to. Where its slide becomes rolling, its friction is over.
double slidesFor(const Island& island, const StepContext& context, const VelocityChange& change, Vec3 run) {
  const BodyIndex body = island.bodies[0];
  const SolvedMotion& s = context.solved[body];
  const VelocityChange now{s.velocity - run, context.bodies->worldInvInertia(body) * s.angularMomentum};
  double steps = std::numeric_limits<double>::infinity();
  island.rows.each([&](const auto& kind, std::size_t k) {
    steps =
        std::min(steps, kind.slidesFor(k, ofRow(kind.ends(k), now), ofRow(kind.ends(k), change), island.dt, context));
  });
  return steps;
}

// Gives back by how much the body started late.
void catchUp(BodyIndex body, StepContext& context) {
  const FreeMotion& free = context.free[body];
  accelerate(body, free.late, context.bodies->worldInertia(body) * free.lateSpin, context);
}

// The forces of this step are about those of the last: no body has hit, and late velocities can be brought up to date.
bool goesOn(const SteadyChange& last, const SteadyChange& now, double radius) {
  auto size = [radius](Vec3 linear, Vec3 angular) { return length(linear) + radius * length(angular); };
  return size(now.linear - last.linear, now.angular - last.angular) <=
         kSameForces * std::max(size(last.linear, last.angular), size(now.linear, now.angular));
}

}  // namespace

void finishLoneBody(const Island& island, Ties& ties, StepContext& context) {
  if (island.bodies.size() != 1 || island.groups.flies(0) || island.facts.partnersGo) return;
  const BodyIndex body = island.bodies[0];
  const std::optional<Vec3> run = runUnder(island, *context.bodies);
  if (!run) return;
  const VelocityChange change = changeOf(body, context);
  if (!steadyContacts(island, context, change)) return;
  const double h = island.dt;
  const Vec3 start = context.free[body].startVelocity - *run, solved = context.solved[body].velocity - *run;
  if (const double part = partUntilStopped(island, context, change, *run); part < 1) {
    const Vec3 along = start * (dot(solved, start) / lengthSquared(start));
    shift(body, start * (0.5 * part * h) - along * h, {}, context);
    accelerate(body, -along, {}, context);
    // The contacts' anchors are to be where the body stops.
    return island.rows.eachKind([&](const auto& kind) { kind.letGo(ties); });
  }
  const SteadyChange& last = context.bodies->data[body].steady;
  const SteadyChange now{change.move * (1 / h), change.turn * (1 / h), h};
  if (last.dt > 0 && !goesOn(last, now, context.bodies->mass[body].outerRadius)) {
    if (last.dt > 2 * h) catchUp(body, context);
    return;
  }
  // In steps: by how much the start was late. From there it is half a step more to the middle of this step.
  const double late = 0.5 * last.dt / h;
  shift(body, change.move * ((late - 0.5) * h), change.turn * ((late - 0.5) * h), context);
  const double on = std::min(late, slidesFor(island, context, change, *run));
  accelerate(body, change.move * on, context.bodies->worldInertia(body) * change.turn * on, context);
  if (on != late) return;
  // The next step begins late by the same angular momentum, in an inertia that has turned.
  const Vec3 torque = context.bodies->worldInertia(body) * now.angular;
  rememberSteady(body, {now.linear, spinAtEnd(body, torque, context), h}, context);
}

}  // namespace brickfall
