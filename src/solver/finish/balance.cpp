#include "solver/finish/balance.h"

#include <algorithm>
#include <cmath>

#include "solver/rigid_sum.h"

namespace brickfall {

namespace {

//! - | too small: rounding of the float solve is taken for a gain | too large: energy may creep up
constexpr double kRelativeSlack = 1e-7;  // of the kinetic energy: rounding of the float solve
//! J/kg | with kRelativeSlack
constexpr double kSlackPerMass = 1e-7;  // J/kg: a lift of 0.01 micrometres

// Orientation at the end of the step: the momentum stays, the body turns under it, and its inertia with it.
Mat3 orientationAtEnd(const StepContext& context, BodyIndex body) {
  const SolvedMotion& s = context.solved[body];
  const BodyMotion& m = context.bodies->motion[body];
  return toMatrix(s.freeTurn ? context.free[body].rotation : normalized(quatFromRotationVector(s.th) * m.rotation));
}
Vec3 spinOf(const StepContext& context, BodyIndex body, Vec3 angularMomentum) {
  Mat3 end = orientationAtEnd(context, body);
  return end * (context.bodies->mass[body].invInertia * transposeTimes(end, angularMomentum));
}
Mat3 inertiaAtEnd(const StepContext& context, BodyIndex body) {
  Mat3 end = orientationAtEnd(context, body);
  return end * context.bodies->mass[body].inertia * transpose(end);
}

// Where the body's centre is at the end of the step: momentum has to be right there.
Vec3 endOf(const StepContext& context, BodyIndex body) {
  return context.bodies->motion[body].position + context.solved[body].d;
}

// The island at the end of the step: as solved, or if nothing had touched.
RigidSum endOfStep(const Island& island, const StepContext& context, bool free) {
  const BodySet& bodies = *context.bodies;
  RigidSum sum(island.origin);
  for (BodyIndex body : island.bodies) {
    const FreeMotion& f = context.free[body];
    const SolvedMotion& s = context.solved[body];
    Vec3 velocity = free ? f.d * (1 / context.dt) : s.velocity;
    double m = bodies.mass[body].mass;
    sum.add(m, bodies.motion[body].position + (free ? f.d : s.d), bodies.worldInertia(body), velocity * m,
            free ? f.angularMomentum : s.angularMomentum);
  }
  return sum;
}

// Where ways and velocities of a floating island were changed apart, the angular momentum of its places and velocities
// drifts. A rigid turn of its velocities brings it back to that of the start of the step and of outside forces.
void restoreSpin(const Island& island, StepContext& context) {
  if (island.grounded()) return;
  RigidSum now = endOfStep(island, context, false), wanted = endOfStep(island, context, true);
  Vec3 centre = now.centre(), turn = inverse(now.inertia()) * (wanted.angularMomentum() - now.angularMomentum());
  for (BodyIndex body : island.bodies) {
    SolvedMotion& s = context.solved[body];
    s.velocity += cross(turn, context.bodies->motion[body].position + s.d - centre);
    s.angularMomentum += context.bodies->worldInertia(body) * turn;
  }
}

struct RigidMotion {
  Vec3 centre, velocity, spin;  // all zero: what is held by the ground has none to keep
};

// The rigid motion with the island's linear and angular momentum.
RigidMotion rigidMotion(const Island& island, const StepContext& context) {
  if (island.grounded()) return {};
  const BodySet& bodies = *context.bodies;
  RigidSum sum(island.origin);
  for (BodyIndex body : island.bodies) {
    const SolvedMotion& s = context.solved[body];
    double m = bodies.mass[body].mass;
    sum.add(m, endOf(context, body), inertiaAtEnd(context, body), s.velocity * m, s.angularMomentum);
  }
  return {sum.centre(), sum.velocity(), sum.spin()};
}

// Takes back from the velocities of an island what kinetic plus potential energy gained in the step beyond the work of
// outside forces. Linear and angular momentum of a floating island are kept: only motion relative to its rigid motion is
// scaled. Islands that something kinematic moves are left alone.
void guardEnergy(const Island& island, StepContext& context) {
  if (island.facts.partnersMove) return;
  const BodySet& bodies = *context.bodies;
  double start = 0, end = 0, gained = 0, mass = 0;
  for (BodyIndex body : island.bodies) {
    const FreeMotion& free = context.free[body];
    const SolvedMotion& s = context.solved[body];
    const BodyData& data = bodies.data[body];
    double m = bodies.mass[body].mass;
    mass += m;
    start += 0.5 * m * lengthSquared(free.startVelocity) +
             0.5 * dot(free.startSpin, bodies.worldInertia(body) * free.startSpin);
    end += 0.5 * m * lengthSquared(s.velocity) + 0.5 * dot(s.angularMomentum, spinOf(context, body, s.angularMomentum));
    gained -= dot(context.gravity * (m * data.gravityScale) + data.force, s.d + s.lost) + dot(data.torque, s.th);
  }
  double allowed = start - gained;  // kinetic energy at the end
  if (!(end > allowed + kRelativeSlack * start + kSlackPerMass * mass)) return;

  RigidMotion rigid = rigidMotion(island, context);
  double relative = 0;
  for (BodyIndex body : island.bodies) {
    Vec3 v = context.solved[body].velocity - rigid.velocity - cross(rigid.spin, endOf(context, body) - rigid.centre);
    Vec3 l = context.solved[body].angularMomentum - inertiaAtEnd(context, body) * rigid.spin;
    relative += 0.5 * bodies.mass[body].mass * lengthSquared(v) + 0.5 * dot(l, spinOf(context, body, l));
  }
  if (!(relative > 0)) return;
  double share = std::sqrt(std::clamp((allowed - (end - relative)) / relative, 0.0, 1.0));
  for (BodyIndex body : island.bodies) {
    SolvedMotion& s = context.solved[body];
    Vec3 v = rigid.velocity + cross(rigid.spin, endOf(context, body) - rigid.centre);
    Vec3 momentum = inertiaAtEnd(context, body) * rigid.spin;
    s.velocity = v + (s.velocity - v) * share;
    s.angularMomentum = momentum + (s.angularMomentum - momentum) * share;
  }
}

}  // namespace

void balance(const Island& island, StepContext& context) {
  if (island.resting()) return;
  restoreSpin(island, context);
  guardEnergy(island, context);
}

}  // namespace brickfall
