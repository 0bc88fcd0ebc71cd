#include "solver/free_motion.h"

#include <algorithm>
#include <cmath>

namespace brickfall {

namespace {

constexpr double kTurnPerSubstep = 0.02;  // rad: energy error of a substep ~ its square

// Decay by exp(-x) without libm: (1 + x/2 + x^2/12)^-1 (1 - x/2 + x^2/12), Pade [2/2], error below 1e-6 for x <= 0.5;
// larger x in halves.
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

}  // namespace

Quat turnFreely(Quat rotation, Vec3 angularMomentum, const Mat3& invInertia, double dt) {
  Vec3 momentum = rotate(conjugate(rotation), angularMomentum);  // in body axes; its length is kept by every part
  double spin = length(invInertia * momentum);
  int substeps = int(std::min(4096.0, std::floor(spin * dt / kTurnPerSubstep) + 1));
  double h = dt / substeps;
  // The kinetic energy is split as L.D L/2 with the diagonal D of the inverse inertia, one axis at a time, and the rest
  // (products of inertia, zero in principal axes) as a turn about a fixed axis evaluated midway.
  Mat3 rest = invInertia;
  Vec3 d{invInertia.row[0].x, invInertia.row[1].y, invInertia.row[2].z};
  for (int i = 0; i < 3; i++) rest.row[i][i] = 0;
  bool principal = true;
  double scale = 1e-9 * (d.x + d.y + d.z);
  for (int i = 0; i < 3; i++) principal = principal && lengthSquared(rest.row[i]) < scale * scale;
  auto turn = [&](Vec3 rotationVectorBody) {
    Quat q = quatFromRotationVector(rotationVectorBody);
    momentum = rotate(conjugate(q), momentum);
    rotation = rotation * q;
  };
  auto axis = [&](int i, double t) {
    Vec3 w;
    w[i] = d[i] * momentum[i] * t;
    turn(w);
  };
  for (int s = 0; s < substeps; s++) {
    axis(0, 0.5 * h);
    axis(1, 0.5 * h);
    if (principal) {
      axis(2, h);
    } else {
      axis(2, 0.5 * h);
      Vec3 w = rest * momentum;
      Vec3 middle = rotate(conjugate(quatFromRotationVector(w * (0.5 * h))), momentum);
      turn((rest * middle) * h);
      axis(2, 0.5 * h);
    }
    axis(1, 0.5 * h);
    axis(0, 0.5 * h);
  }
  return normalized(rotation);
}

void predictFreeMotion(StepContext& context, BodyIndex body, double airDensity, bool hasContacts) {
  BodySet& bodies = *context.bodies;
  BodyMotion& m = bodies.motion[body];
  const BodyMass& mass = bodies.mass[body];
  BodyData& data = bodies.data[body];
  FreeMotion& free = context.free[body];
  double dt = context.dt;
  free.startVelocity = m.linearVelocity;
  free.startSpin = m.angularVelocity;

  if (data.linearDamping > 0) m.linearVelocity *= decay(data.linearDamping * dt);
  if (data.angularDamping > 0) m.angularVelocity *= decay(data.angularDamping * dt);
  if (data.dragArea > 0) {  // dv/dt = -c |v| v solved exactly: v / (1 + c |v| t); gravity is split off (second order)
    double c = 0.5 * airDensity * data.dragArea * mass.invMass;
    Vec3 half = context.gravity * (0.5 * dt * data.gravityScale);
    Vec3 v = m.linearVelocity + half;
    m.linearVelocity = v * (1 / (1 + c * length(v) * dt)) - half;
  }
  if (hasContacts && !mass.round) {
    double turn = length(m.angularVelocity) * dt;
    if (turn > kLargestTurn) m.angularVelocity *= kLargestTurn / turn;
  }
  Vec3 acceleration = context.gravity * data.gravityScale + data.force * mass.invMass;
  free.d = (m.linearVelocity + acceleration * dt) * dt;

  Vec3 spin = m.angularVelocity;
  Vec3 momentum = bodies.worldInertia(body) * spin + data.torque * dt;
  free.angularMomentum = momentum;
  spin = bodies.worldInvInertia(body) * momentum;
  if (mass.isotropic || lengthSquared(spin) * dt * dt < 1e-12) {
    free.th = spin * dt;
    free.rotation = normalized(quatFromRotationVector(free.th) * m.rotation);
    return;
  }
  free.rotation = turnFreely(m.rotation, momentum, mass.invInertia, dt);
  free.th = rotationVector(normalized(free.rotation * conjugate(m.rotation)));
}

}  // namespace brickfall
