#include "solver/finish/plastic_hit.h"

#include "solver/finish/motion.h"

namespace brickfall {

namespace {

// How the velocity of the place at `arm` of a body changes by an impulse there, m/s per N s. By the body's inertia at
// the end of the step: energies are read there.
Mat3 mobilityAt(BodyIndex body, Vec3 arm, const StepContext& context) {
  Mat3 out;
  for (int axis = 0; axis < 3; axis++) {
    Vec3 impulse;
    impulse[axis] = 1;
    const Vec3 v =
        impulse * context.bodies->mass[body].invMass + cross(spinAtEnd(body, cross(arm, impulse), context), arm);
    for (int row = 0; row < 3; row++) out.row[row][axis] = v[row];
  }
  return out;
}

void push(BodyIndex body, Vec3 impulse, Vec3 arm, StepContext& context) {
  const double before = kineticEnergyAtEnd(body, {}, context);
  accelerate(body, impulse * context.bodies->mass[body].invMass, cross(arm, impulse), context);
  keepHit(body, kineticEnergyAtEnd(body, {}, context) - before, context);
}

}  // namespace

void hitPlastically(BodyIndex light, BodyIndex heavy, double rest, StepContext& context) {
  const BodySet& bodies = *context.bodies;
  const SolvedMotion &l = context.solved[light], &h = context.solved[heavy];
  const double time = rest * context.free[heavy].dt;
  auto fallen = [&](BodyIndex body) {  // m/s, in that time, under outside forces
    const FreeMotion& free = context.free[body];
    return (free.d * (1 / free.dt) - free.startVelocity) * rest;
  };
  accelerate(light, fallen(light), {}, context);
  const Vec3 fall = fallen(heavy) * (0.5 * time);  // m: a body goes so much less far than by its velocity at the end
  const Vec3 met = bodies.motion[light].position + l.d;
  const Vec3 arm = met - (bodies.motion[heavy].position + h.d - h.velocity * time + fall);
  const Vec3 under = h.velocity + cross(spinAtEnd(heavy, h.angularMomentum, context), arm), before = h.velocity;
  const Mat3 mobility = mobilityAt(heavy, arm, context) + mobilityAt(light, {}, context);
  const Vec3 impulse = inverse(mobility) * (under - l.velocity);
  push(light, impulse, {}, context);
  push(heavy, -impulse, arm, context);
  shift(light, l.velocity * time - fall, {}, context);
  shift(heavy, (h.velocity - before) * time, {}, context);
}

}  // namespace brickfall
