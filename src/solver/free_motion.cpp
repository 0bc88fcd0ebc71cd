#include "solver/free_motion.h"

#include <cmath>

#include "math/free_turn.h"

namespace brickfall {

namespace {

// Decay by exp(-x) without libm: (1 + x/2 + x^2/12)^-1 (1 - x/2 + x^2/12), Pade [2/2]. The relative error is x^5 / 720:
// 5e-5 for x = 0.5. Larger x are taken in halves.
double decay(double x) {
  int halvings = 0;
  while (x > 0.5 && halvings < 60) {
    x *= 0.5;
    halvings++;
  }
  double even = 1 + x * x / 12, share = (even - 0.5 * x) / (even + 0.5 * x);
  for (int i = 0; i < halvings; i++) share *= share;
  return share;
}

// The part of a fast turn that the solve sees, of a body with contacts. Taken from the spin: a rotation vector wraps at
// half a turn, a spin does not.
//
// A body that does not turn so fast yet is turned so far by a torque or a blow only in its free motion: all of either
// is for its ties to bear.
void limitTurn(FreeMotion& free, const BodyMass& mass, const BodyMotion& m, Vec3 spin, double dt) {
  if (!(lengthSquared(spin) * dt * dt > kLargestTurn * kLargestTurn)) return;
  if (!(lengthSquared(free.startSpin - free.struckSpin) * dt * dt > kLargestTurn * kLargestTurn)) {
    free.th = spin * dt;
    return;
  }
  Vec3 turn = spin * dt;
  Vec3 visible = free.asOne ? turn : visibleTurn(mass, m.orientation, turn);
  double size = length(visible);
  if (free.held && size > kLargestTurn) {
    free.th = rotationVector(normalized(free.rotation * conjugate(m.rotation)));
    return;
  }
  free.turnsFaster = size > kLargestTurn;
  free.seen = free.turnsFaster ? kLargestTurn / size : 1;
  free.th = turn - visible + visible * free.seen;
}

// Free motion by one of the integrators that are there to be compared.
void integrateFreely(StepContext& context, BodyIndex body, Vec3 acceleration, double dt) {
  const BodyMotion& m = context.bodies->motion[body];
  FreeMotion& free = context.free[body];
  RigidMass mass{context.bodies->mass[body].mass, context.bodies->mass[body].inertia};
  LoadFunction load = [&](const RigidState&, double) {
    return RigidLoad{acceleration * mass.mass, context.bodies->data[body].torque};
  };
  RigidState start{m.position, m.rotation, m.linearVelocity, m.angularVelocity};
  RigidState end = integrated(context.integrator, start, mass, load, dt);
  free.d = end.velocity * dt;
  free.way = end.position - start.position;
  free.rotation = end.rotation;
  free.th = rotationVector(normalized(end.rotation * conjugate(start.rotation)));
  free.angularMomentum = spinMomentum(end, mass);
}

// Applies forces, damping and drag, all for `forces` s, and finds the way of the body's centre in `dt` s.
void predictWay(StepContext& context, BodySet& bodies, BodyIndex body, double dt, double forces, Vec3 acceleration) {
  BodyMotion& m = bodies.motion[body];
  const BodyData& data = bodies.data[body];
  FreeMotion& free = context.free[body];
  if (data.linearDamping > 0) m.linearVelocity *= decay(data.linearDamping * forces);
  if (data.angularDamping > 0) m.angularVelocity *= decay(data.angularDamping * forces);
  if (data.dragArea > 0) {  // dv/dt = -c |v| v solved exactly: v / (1 + c |v| t); gravity is split off (second order)
    double c = 0.5 * context.airDensity * data.dragArea * bodies.mass[body].invMass;
    Vec3 half = context.gravity * (0.5 * forces * data.gravityScale);
    Vec3 v = m.linearVelocity + half;
    m.linearVelocity = v * (1 / (1 + c * length(v) * forces)) - half;
  }
  free.d = (m.linearVelocity - free.late + acceleration * forces) * dt;
  free.way = (free.startVelocity * dt + free.d) * 0.5;
}

// Drag splits off gravity, along locked axes as well.
void keepLocks(FreeMotion& free, BodySet& bodies, BodyIndex body) {
  bodies.motion[body].linearVelocity = bodies.freeWay(body, bodies.motion[body].linearVelocity);
  free.d = bodies.freeWay(body, free.d);
  free.way = bodies.freeWay(body, free.way);
}

// The turn of a body with locks, about the free axes alone: by the spin in the middle of the step. Its angular momentum
// along free axes stays but for torques; where its inertia about them changes as it turns, it gains no energy by that.
Vec3 predictLockedTurn(FreeMotion& free, const BodySet& bodies, BodyIndex body, Vec3 momentum, double dt) {
  const BodyMotion& m = bodies.motion[body];
  const Vec3 spin = bodies.worldInvInertia(body) * momentum;
  auto turned = [&](Vec3 by) { return normalized(quatFromRotationVector(by) * m.rotation); };
  free.th = bodies.spinAt(body, toMatrix(turned(spin * (0.5 * dt))), momentum) * dt;
  free.rotation = turned(free.th);
  const double had = dot(spin, momentum), has = dot(bodies.spinAt(body, toMatrix(free.rotation), momentum), momentum);
  free.angularMomentum = has > had ? momentum * std::sqrt(had / has) : momentum;
  return spin;
}

// Bodies whose turn is still to be found, until there are enough of them to find it side by side.
class WaitingTurns {
 public:
  WaitingTurns(StepContext& context, const BodySet& bodies, double dt, bool hasContacts)
      : context_(context), bodies_(bodies), dt_(dt), hasContacts_(hasContacts) {}
  ~WaitingTurns() { turnAll(); }
  WaitingTurns(const WaitingTurns&) = delete;
  WaitingTurns& operator=(const WaitingTurns&) = delete;

  void add(BodyIndex body, Vec3 spin) {
    const BodyMass& mass = bodies_.mass[body];
    turns_[count_] = {bodies_.motion[body].rotation,
                      context_.free[body].angularMomentum,
                      {mass.principalAxes, mass.principalInvInertia}};
    body_[count_] = body;
    spin_[count_++] = spin;
    if (count_ == kTurnsAtOnce) turnAll();
  }

 private:
  void turnAll() {
    turnFreely(turns_, count_, dt_);
    for (int i = 0; i < count_; i++) {
      const BodyMotion& m = bodies_.motion[body_[i]];
      FreeMotion& free = context_.free[body_[i]];
      free.rotation = turns_[i].rotation;
      free.th = rotationVector(normalized(free.rotation * conjugate(m.rotation)));
      if (hasContacts_) limitTurn(free, bodies_.mass[body_[i]], m, spin_[i], dt_);
    }
    count_ = 0;
  }

  StepContext& context_;
  const BodySet& bodies_;
  double dt_;
  bool hasContacts_;
  int count_ = 0;
  FreeTurn turns_[kTurnsAtOnce];
  BodyIndex body_[kTurnsAtOnce];
  Vec3 spin_[kTurnsAtOnce];
};

}  // namespace

Vec3 visibleTurn(const BodyMass& mass, const Mat3& orientation, Vec3 th) {
  if (mass.round) return {};
  if (mass.symmetryAxis == Vec3{}) return th;
  Vec3 axis = orientation * mass.symmetryAxis;
  return th - axis * dot(axis, th);
}

void predictFreeMotions(StepContext& context, BodySet& bodies, std::span<const BodyIndex> list, double dt,
                        bool hasContacts, bool swings) {
  WaitingTurns waiting(context, bodies, dt, hasContacts);
  for (BodyIndex body : list) {
    const BodyMotion& m = bodies.motion[body];
    const BodyMass& mass = bodies.mass[body];
    const BodyData& data = bodies.data[body];
    FreeMotion& free = context.free[body];
    free.dt = free.turnTime = dt;
    free.turnsFaster = false;
    free.seen = 1;
    free.startVelocity = m.linearVelocity;
    free.startSpin = m.angularVelocity;
    free.late = free.lateSpin = {};
    const bool locked = mass.locks != 0;
    Vec3 acceleration = bodies.freeWay(body, context.gravity * data.gravityScale + data.force * mass.invMass);
    if (data.steady.swings != swings) bodies.data[body].steady = {};
    if (swings) {
      free.late = data.steady.linear * (0.5 * dt);
      free.lateSpin = data.steady.angular * (0.5 * dt);
    } else if (hasContacts && list.size() == 1) {
      free.late = data.steady.linear * (0.5 * data.steady.dt);
      free.lateSpin = data.steady.angular * (0.5 * data.steady.dt);
    }
    const double left = hasContacts ? dt * (1 - context.aheadOf(body)) : dt;  // forces act for so long
    predictWay(context, bodies, body, dt, left, acceleration);
    if (locked) keepLocks(free, bodies, body);
    if (!locked && !hasContacts && context.integrator != Integrator::splitting) {
      integrateFreely(context, body, acceleration, dt);
      continue;
    }
    Vec3 momentum = bodies.worldInertia(body) * (m.angularVelocity - free.lateSpin) + data.torque * left;
    if (bodies.turnsLocked(body)) {
      const Vec3 turning = predictLockedTurn(free, bodies, body, momentum, dt);
      if (hasContacts) limitTurn(free, mass, m, turning, dt);
      continue;
    }
    free.angularMomentum = momentum;
    Vec3 spin = bodies.worldInvInertia(body) * momentum;
    if (!mass.isotropic && !(lengthSquared(spin) * dt * dt < 1e-12)) {
      waiting.add(body, spin);
      continue;
    }
    free.th = spin * dt;
    free.rotation = normalized(quatFromRotationVector(free.th) * m.rotation);
    if (hasContacts) limitTurn(free, mass, m, spin, dt);
  }
}

Vec3 shortenFreeTurn(StepContext& context, BodyIndex body, double share) {
  const BodyMass& mass = context.bodies->mass[body];
  FreeMotion& free = context.free[body];
  free.turnTime *= share;
  if (context.bodies->turnsLocked(body)) {
    const Vec3 turn = free.th * (free.turnTime / (free.dt * free.seen));
    free.rotation = normalized(quatFromRotationVector(turn) * context.bodies->motion[body].rotation);
    return turn;
  }
  free.rotation = turnFreely(context.bodies->motion[body].rotation, free.angularMomentum,
                             {mass.principalAxes, mass.principalInvInertia}, free.turnTime);
  return rotationVector(normalized(free.rotation * conjugate(context.bodies->motion[body].rotation)));
}

}  // namespace brickfall
