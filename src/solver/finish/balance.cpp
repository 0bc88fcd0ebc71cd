#include "solver/finish/balance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/rigid_sum.h"
#include "solver/support.h"

namespace brickfall {

namespace {

//! - | too small: rounding of the float solve is taken for a gain | too large: energy may creep up
constexpr double kRelativeSlack = 1e-7;  // of the kinetic energy: rounding of the float solve
//! J/kg | with kRelativeSlack
constexpr double kSlackPerMass = 1e-7;  // J/kg: a lift of 0.01 micrometres

//! m/s | too small: what leans under a great load falls | too large: what rocks in a small island is braked
constexpr double kSwaySpeed = 0.1;

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

// What something presses on at the end of the step: as solved, or if nothing had touched.
RigidSum endOfStep(const Island& island, const StepContext& context, bool free) {
  const BodySet& bodies = *context.bodies;
  RigidSum sum(island.origin);
  for (BodyIndex body : island.bodies) {
    const FreeMotion& f = context.free[body];
    const SolvedMotion& s = context.solved[body];
    if (!s.pressed) continue;
    Vec3 velocity = free ? f.d * (1 / island.dt) : s.velocity;
    double m = bodies.mass[body].mass;
    sum.add(m, bodies.motion[body].position + (free ? f.d : s.d), bodies.worldInertia(body), velocity * m,
            free ? f.angularMomentum : s.angularMomentum);
  }
  return sum;
}

// Where ways and velocities of a floating island were changed apart, the angular momentum of its places and velocities
// drifts. A rigid motion of the velocities of what is pressed on brings both momenta back to those of the start of the step and of
// outside forces: what nothing touches flies on.
void restoreMomentum(const Island& island, StepContext& context) {
  if (island.grounded()) return;
  const RigidSum now = endOfStep(island, context, false), wanted = endOfStep(island, context, true);
  if (!(now.mass() > 0)) return;
  const Vec3 push = wanted.velocity() - now.velocity(), centre = now.centre();
  const Vec3 turn = inverse(now.inertia()) * (wanted.angularMomentum() - now.angularMomentum());
  for (BodyIndex body : island.bodies) {
    SolvedMotion& s = context.solved[body];
    if (!s.pressed) continue;
    s.velocity += push + cross(turn, context.bodies->motion[body].position + s.d - centre);
    s.angularMomentum += context.bodies->worldInertia(body) * turn;
  }
}

double kineticEnergy(const StepContext& context, BodyIndex body) {
  const SolvedMotion& s = context.solved[body];
  return 0.5 * context.bodies->mass[body].mass * lengthSquared(s.velocity) +
         0.5 * dot(s.angularMomentum, spinOf(context, body, s.angularMomentum));
}

struct IslandEnergy {
  double start = 0, end = 0;  // J, kinetic
  double work = 0;            // J, of gravity and outside forces, and what earlier steps of an impact took
  double mass = 0;
  double unit = 1;                                      // gravity x size, of the reference
  double excess() const { return end - start - work; }  // at the end, over what it was given
  double slack() const { return kRelativeSlack * start + kSlackPerMass * unit * mass; }
};
IslandEnergy energyOf(const Island& island, const StepContext& context) {
  IslandEnergy sum;
  sum.work = island.credit;
  sum.unit = island.facts.scale.speed * island.facts.scale.speed;
  for (BodyIndex body : island.bodies) {
    const FreeMotion& free = context.free[body];
    const SolvedMotion& s = context.solved[body];
    const BodyData& data = context.bodies->data[body];
    double m = context.bodies->mass[body].mass;
    sum.mass += m;
    sum.start += 0.5 * m * lengthSquared(free.startVelocity) +
                 0.5 * dot(free.startSpin, context.bodies->worldInertia(body) * free.startSpin);
    sum.end += kineticEnergy(context, body);
    sum.work += dot(context.gravity * (m * data.gravityScale) + data.force, s.d + s.lost) + dot(data.torque, s.th);
  }
  return sum;
}

// What a solve left out of balance has acted like a force from nowhere. Velocities take back the same share of its impulse on
// each body, so much that no energy is gained: what is in balance, or touches nothing, is left alone, and momentum comes out
// better than it was. Returns the excess that is left.
double takeResidual(const Island& island, StepContext& context, double excess) {
  if (island.residual.size() != island.bodies.size()) return excess;
  auto impulse = [&](std::size_t i) {
    const Wrench& r = island.residual[i];
    return std::pair{toDouble(r.force) * island.dt, toDouble(r.torque) * island.dt};
  };
  // Of a share x of all impulses: energy changes by linear x + square x^2.
  double linear = 0, square = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    BodyIndex body = island.bodies[i];
    const SolvedMotion& s = context.solved[body];
    auto [push, twist] = impulse(i);
    Vec3 spin = spinOf(context, body, twist);
    linear += dot(push, s.velocity) + dot(spin, s.angularMomentum);
    square += 0.5 * lengthSquared(push) * context.bodies->mass[body].invMass + 0.5 * dot(twist, spin);
  }
  if (!(linear < 0) || !(square > 0)) return excess;
  double share = std::min(1.0, -linear / (2 * square)), root = linear * linear - 4 * square * excess;
  if (root > 0) share = std::min(share, (-linear - std::sqrt(root)) / (2 * square));
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    SolvedMotion& s = context.solved[island.bodies[i]];
    auto [push, twist] = impulse(i);
    s.velocity += push * (share * context.bodies->mass[island.bodies[i]].invMass);
    s.angularMomentum += twist * share;
  }
  return excess + linear * share + square * share * share;
}

// What elastic joints give back is no gain, but makes what stands sway: while nothing moves fast, it is taken from what presses on what
// is fixed, by chains of such, and not from what that slides by as a whole, where friction can't hold it. Large islands sway little
// enough without it.
void dampSway(const Island& island, StepContext& context, double excess) {
  if (island.plan.large || island.facts.fastest > kSwaySpeed) return;
  std::pmr::vector<char> held(island.memory);
  findSupported(island, held, [&](const auto& kind, std::size_t k) { return kind.carriesForce(k, context); });
  const Vec3 slide = slideLeft(island, held, context, [&](BodyIndex body) { return context.solved[body].velocity; });
  double energy = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    if (!held[i]) continue;
    const BodyIndex body = island.bodies[i];
    const Vec3 spin = context.solved[body].angularMomentum;
    energy += 0.5 * context.bodies->mass[body].mass * lengthSquared(context.solved[body].velocity - slide) +
              0.5 * dot(spin, spinOf(context, body, spin));
  }
  if (!(energy > 0)) return;
  double share = std::sqrt(std::max(0.0, 1 - excess / energy));
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    if (!held[i]) continue;
    SolvedMotion& s = context.solved[island.bodies[i]];
    s.velocity = slide + (s.velocity - slide) * share;
    s.angularMomentum = s.angularMomentum * share;
  }
}

Mat3 inertiaAtEnd(const StepContext& context, BodyIndex body) {
  Mat3 end = orientationAtEnd(context, body);
  return end * context.bodies->mass[body].inertia * transpose(end);
}

// What a floating island has gained (also by compression in one step that rebounds in the next) is taken from what the bodies that
// something presses on move against their rigid motion: linear and angular momentum are kept, and what nothing touches flies on.
void takeRelativeMotion(const Island& island, StepContext& context, double excess) {
  const BodySet& bodies = *context.bodies;
  auto each = [&](auto&& act) {
    for (BodyIndex body : island.bodies)
      if (context.solved[body].pressed) act(body);
  };
  RigidSum sum(island.origin);
  auto endOf = [&](BodyIndex body) { return bodies.motion[body].position + context.solved[body].d; };
  each([&](BodyIndex body) {
    const SolvedMotion& s = context.solved[body];
    double m = bodies.mass[body].mass;
    sum.add(m, endOf(body), inertiaAtEnd(context, body), s.velocity * m, s.angularMomentum);
  });
  Vec3 centre = sum.centre(), velocity = sum.velocity(), spin = sum.spin();
  double relative = 0;
  each([&](BodyIndex body) {
    Vec3 v = context.solved[body].velocity - velocity - cross(spin, endOf(body) - centre);
    Vec3 l = context.solved[body].angularMomentum - inertiaAtEnd(context, body) * spin;
    relative += 0.5 * bodies.mass[body].mass * lengthSquared(v) + 0.5 * dot(l, spinOf(context, body, l));
  });
  if (!(relative > 0)) return;
  double share = std::sqrt(std::max(0.0, 1 - excess / relative));
  each([&](BodyIndex body) {
    SolvedMotion& s = context.solved[body];
    Vec3 v = velocity + cross(spin, endOf(body) - centre), momentum = inertiaAtEnd(context, body) * spin;
    s.velocity = v + (s.velocity - v) * share;
    s.angularMomentum = momentum + (s.angularMomentum - momentum) * share;
  });
}

// Takes back from the velocities of an island what kinetic plus potential energy gained in the step beyond the work of
// outside forces. Islands that something kinematic moves are left alone.
void guardEnergy(const Island& island, StepContext& context) {
  if (island.facts.partnersMove || island.leapt) return;
  IslandEnergy energy = energyOf(island, context);
  if (!(energy.excess() > energy.slack())) return;
  if (!island.grounded()) return takeRelativeMotion(island, context, energy.excess());
  double left = takeResidual(island, context, energy.excess());
  if (left > energy.slack()) dampSway(island, context, left);
}

}  // namespace

void balance(const Island& island, StepContext& context) {
  if (island.resting()) return;
  restoreMomentum(island, context);
  guardEnergy(island, context);
}

}  // namespace brickfall
