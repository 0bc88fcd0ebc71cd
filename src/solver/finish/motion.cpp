#include "solver/finish/motion.h"

#include "solver/free_motion.h"
#include "solver/rigid_sum.h"

namespace brickfall {

namespace {

//! not of the method: rotation vectors beyond are those of turns the other way round, which no solve can mean
constexpr double kHalfTurn = 3;  // rad

// To the last bit: nothing that a body does here goes along its locks.
void keepLocks(BodyIndex body, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  if (bodies.mass[body].locks == 0) return;
  SolvedMotion& s = context.solved[body];
  s.d = bodies.freeWay(body, s.d);
  s.th = bodies.freeTurn(body, s.th);
  s.velocity = bodies.freeWay(body, s.velocity);
}

void shortenTurn(BodyIndex body, double share, StepContext& context) {
  SolvedMotion& s = context.solved[body];
  s.th *= share;
  if (!s.freeTurn && !context.free[body].turnsFaster) return;
  const Vec3 turned = shortenFreeTurn(context, body, share);
  if (s.freeTurn && lengthSquared(s.th) <= kHalfTurn * kHalfTurn) s.th = turned;
}

}  // namespace

void storeMotion(const Island& island, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  double perDt = 1 / island.dt;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyIndex body = island.bodies[i];
    SolvedMotion& out = context.solved[body];
    const FreeMotion& free = context.free[body];
    const SolveMotion& m = island.motion[i];
    out = {};
    out.rest = island.resting();
    out.freeTurn = !out.rest;
    out.foreseen = !context.hasMoved(body);
    if (out.rest) continue;
    const std::uint32_t group = island.groups.groupOf(i);
    out.flying = out.steady.swings = island.groups.flies(group);
    const bool alone = out.flying && island.groups.bodies(group).size() == 1;
    out.freeTurn = alone || m.th == island.masses[i].thFree;
    // A body that nothing presses on goes its own way, whatever part of its weight cycles left.
    const Vec3 at = context.bodies->motion[body].position;
    out.d = alone ? free.d : island.rigid.of(at) + toDouble(m.d);
    out.th = out.freeTurn ? free.th : island.rigid.turn + toDouble(m.th);
    out.velocity = alone ? free.d * perDt : (island.rigid.endOf(at) + toDouble(m.d)) * perDt;
    out.angularMomentum = free.angularMomentum;
    if (alone) {
      out.d += free.late * island.dt;
      out.velocity += free.late;
      out.angularMomentum += bodies.worldInertia(body) * free.lateSpin;
    }
    // Torque impulses are added to the angular momentum, so that it is kept to rounding.
    const Vec3 turned = out.freeTurn ? Vec3{} : toDouble(m.th) - toDouble(island.masses[i].thFree);
    out.angularMomentum += bodies.worldInertia(body) * turned * perDt;
    // What the solve saw of a fast turn lies on the way of the whole turn: all along it, energy stays as it is.
    if (!out.freeTurn && free.turnsFaster) shortenFreeTurn(context, body, free.seen);
    keepLocks(body, context);
  }
}

void turnFarFreely(const Island& island, StepContext& context) {
  for (BodyIndex body : island.bodies) {
    SolvedMotion& s = context.solved[body];
    FreeMotion& free = context.free[body];
    const double most = s.flying && !island.facts.jointed && !island.facts.mortared ? kLargestTurn : kHalfTurn;
    if (s.freeTurn || !(lengthSquared(s.th) > most * most) || context.bodies->turnsLocked(body)) continue;
    s.freeTurn = true;
    free.angularMomentum = s.angularMomentum;
    free.turnsFaster = false;
    free.turnTime = free.dt;
    shortenFreeTurn(context, body, 1);
  }
}

void storeFreeBody(BodyIndex body, double dt, StepContext& context) {
  const FreeMotion& free = context.free[body];
  SolvedMotion& out = context.solved[body];
  out = {};
  out.velocity = free.d * (1 / dt) + free.late;
  out.d = free.way + free.late * (0.5 * dt);
  out.th = free.th;
  out.angularMomentum = free.angularMomentum;
  out.flying = out.steady.swings = true;
}

void goFreely(BodyIndex body, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  FreeMotion& free = context.free[body];
  const double forces = free.dt * (1 - context.aheadOf(body));
  free.angularMomentum =
      bodies.worldInertia(body) * bodies.motion[body].angularVelocity + bodies.data[body].torque * forces;
  free.turnTime = free.dt;
  free.turnsFaster = false;
  free.seen = 1;
  storeFreeBody(body, free.dt, context);
  context.solved[body].foreseen = false;
  shortenFreeTurn(context, body, 1);
  if (context.aheadOf(body) > 0) takeBackAhead(body, context);
  context.freed = true;
}

void goAsOne(std::span<const std::uint32_t> group, const Island& island, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  RigidSum sum(island.origin), fall(island.origin);
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const FreeMotion& free = context.free[body];
    const double m = bodies.mass[body].mass;
    const Mat3 inertia = bodies.worldInertia(body);
    const Vec3 spin = inertia * bodies.motion[body].angularVelocity + bodies.data[body].torque * free.dt;
    const Vec3 way = free.d + free.late * free.dt;
    sum.add(m, bodies.motion[body].position, inertia, way * m, spin * free.dt);
    fall.add(m, bodies.motion[body].position, inertia, (way - free.startVelocity * free.dt) * m, {});
  }
  const RigidWay way = rigidWayOf(sum);
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const Vec3 at = bodies.motion[body].position;
    SolvedMotion& out = context.solved[body];
    context.free[body].turnsFaster = out.freeTurn = false;
    context.free[body].asOne = true;
    out.d = way.of(at) - fall.velocity() * 0.5;
    out.th = way.turn;
    out.velocity = way.endOf(at) * (1 / island.dt);
    const Mat3 end = toMatrix(rotationAtEnd(body, context));
    out.angularMomentum = end * (bodies.mass[body].inertia * transposeTimes(end, way.spin)) * (1 / island.dt);
  }
}

bool solvedWell(const Island& island, const StepContext& context) {
  for (BodyIndex body : island.bodies) {
    const SolvedMotion& s = context.solved[body];
    if (!isFinite(s.d) || !isFinite(s.th) || !isFinite(s.velocity) || !isFinite(s.angularMomentum)) return false;
  }
  return true;
}

VelocityChange changeOf(BodyIndex body, const StepContext& context) {
  const FreeMotion& free = context.free[body];
  const SolvedMotion& s = context.solved[body];
  return {s.velocity - (free.startVelocity - free.late),
          context.bodies->worldInvInertia(body) * s.angularMomentum - (free.startSpin - free.lateSpin)};
}

EndChanges changesOf(RowEnds ends, const Island& island, const StepContext& context) {
  auto of = [&](std::uint32_t body) {
    return body < island.bodies.size() ? changeOf(island.bodies[body], context) : VelocityChange{};
  };
  return {of(ends.a), of(ends.b)};
}

Lead leadOf(BodyIndex body, const StepContext& context) {
  const FreeMotion& free = context.free[body];
  const SolvedMotion& s = context.solved[body];
  if (s.flying) return {};
  const double half = s.steady.swings ? 0.5 * s.steady.dt : 0;
  return {{free.late, free.lateSpin}, {s.steady.linear * half, s.steady.angular * half}};
}

Quat rotationAtEnd(BodyIndex body, const StepContext& context) {
  const SolvedMotion& s = context.solved[body];
  const FreeMotion& free = context.free[body];
  if (s.freeTurn) return free.rotation;
  const bool faster = free.turnsFaster;
  const Vec3 turn = faster ? s.th - free.th * (free.turnTime / (free.dt * free.seen)) : s.th;
  const Quat from = faster ? free.rotation : context.bodies->motion[body].rotation;
  // Joints are solved for bodies that turn about their axis of symmetry first, and then with that (joint/arcs.h).
  if (!free.jointed || free.asOne) return normalized(quatFromRotationVector(turn) * from);
  const Vec3 visible = visibleTurn(context.bodies->mass[body], toMatrix(from), turn);
  return normalized(quatFromRotationVector(visible) * (quatFromRotationVector(turn - visible) * from));
}

Vec3 spinAtEnd(BodyIndex body, Vec3 angularMomentum, const StepContext& context) {
  const Mat3 end = toMatrix(rotationAtEnd(body, context));
  return context.bodies->spinAt(body, end, angularMomentum);
}

double kineticEnergyAtEnd(BodyIndex body, Vec3 frame, const StepContext& context) {
  const SolvedMotion& s = context.solved[body];
  return 0.5 * context.bodies->mass[body].mass * lengthSquared(s.velocity - frame) +
         0.5 * dot(s.angularMomentum, spinAtEnd(body, s.angularMomentum, context));
}

void shift(BodyIndex body, Vec3 way, Vec3 turn, StepContext& context) {
  SolvedMotion& s = context.solved[body];
  s.d += way;
  if (!s.freeTurn) s.th += turn;
  keepLocks(body, context);
}

// Along its velocity: then the angular momentum of its group stays.
void takeBackAhead(BodyIndex body, StepContext& context) {
  SolvedMotion& s = context.solved[body];
  const FreeMotion& free = context.free[body];
  const double share = context.ahead[body].share;
  const Vec3 forces = s.flying ? (free.d * (1 / free.dt) + free.late - free.startVelocity) * 0.5 : Vec3{};
  s.d -= (s.velocity - forces - context.ahead[body].frame) * (share * free.dt);
  shortenTurn(body, 1 - share, context);
  keepLocks(body, context);
}

void accelerate(BodyIndex body, Vec3 velocity, Vec3 angularMomentum, StepContext& context) {
  context.solved[body].velocity += velocity;
  context.solved[body].angularMomentum += angularMomentum;
  keepLocks(body, context);
}

void shorten(BodyIndex body, double share, double turnShare, Vec3 carried, bool falls, StepContext& context) {
  SolvedMotion& s = context.solved[body];
  const FreeMotion& free = context.free[body];
  const double lost = s.went * (1 - share);
  s.foreseen = false;
  s.d = s.d * share + carried;
  s.went *= share;
  if (falls) {
    s.velocity -= (free.d * (1 / free.dt) - free.startVelocity) * lost;
    s.angularMomentum -= context.bodies->data[body].torque * (lost * free.dt);
  }
  if (turnShare < 1) shortenTurn(body, turnShare, context);
  keepLocks(body, context);
}

void keepLoss(BodyIndex body, double loss, StepContext& context) { context.solved[body].impactLoss = loss; }

void rememberSteady(BodyIndex body, const SteadyChange& change, StepContext& context) {
  context.solved[body].steady = change;
}

}  // namespace brickfall
