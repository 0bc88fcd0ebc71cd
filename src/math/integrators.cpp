#include "brickfall/integrators.h"

#include "math/free_turn.h"

namespace brickfall {

namespace {

// Equations of motion with the angular momentum L as unknown: x' = v, v' = F / m, q' = w q / 2, L' = torque.
struct Unknowns {
  Vec3 position;
  Quat rotation;
  Vec3 velocity;
  Vec3 momentum;
};

Quat operator+(Quat a, Quat b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
Quat scaledBy(Quat q, double s) { return {q.x * s, q.y * s, q.z * s, q.w * s}; }
Quat rate(Quat q, Vec3 spin) { return scaledBy(Quat{spin.x, spin.y, spin.z, 0} * q, 0.5); }

class Body {
 public:
  Body(const RigidMass& mass, const LoadFunction& load)
      : mass_(mass), invInertia_(inverse(mass.inertia)), load_(load) {}

  Vec3 spin(Quat q, Vec3 momentum) const { return rotate(q, invInertia_ * rotate(conjugate(q), momentum)); }
  RigidState state(const Unknowns& y) const {
    Quat q = normalized(y.rotation);
    return {y.position, q, y.velocity, spin(q, y.momentum)};
  }
  Unknowns unknowns(const RigidState& s) const { return {s.position, s.rotation, s.velocity, spinMomentum(s, mass_)}; }
  RigidLoad load(const RigidState& s, double time) const { return load_(s, time); }
  Vec3 acceleration(const RigidLoad& l) const { return l.force * (1 / mass_.mass); }

  // Angular acceleration, with the gyroscopic torque of the state.
  Vec3 angularAcceleration(const RigidState& s, Vec3 torque) const {
    Vec3 w = rotate(conjugate(s.rotation), s.angularVelocity), t = rotate(conjugate(s.rotation), torque);
    return rotate(s.rotation, invInertia_ * (t - cross(w, mass_.inertia * w)));
  }

  RigidState explicitEuler(const RigidState& s, double dt) const {
    RigidLoad l = load(s, 0);
    RigidState next = s;
    next.position += s.velocity * dt;
    next.velocity += acceleration(l) * dt;
    next.rotation = normalized(s.rotation + scaledBy(rate(s.rotation, s.angularVelocity), dt));
    next.angularVelocity += angularAcceleration(s, l.torque) * dt;
    return next;
  }

  RigidState semiImplicitEuler(const RigidState& s, double dt, bool implicitSpin) const {
    RigidLoad l = load(s, 0);
    RigidState next = s;
    next.velocity += acceleration(l) * dt;
    next.position += next.velocity * dt;
    next.angularVelocity =
        implicitSpin ? spinAtEnd(s, l.torque, dt) : s.angularVelocity + angularAcceleration(s, l.torque) * dt;
    next.rotation = normalized(s.rotation + scaledBy(rate(s.rotation, next.angularVelocity), dt));
    return next;
  }

  // w1 of I (w1 - w0) + dt w1 x I w1 = dt torque, in body axes, by Newton's method (Catto, GDC 2015, takes one step).
  Vec3 spinAtEnd(const RigidState& s, Vec3 torque, double dt) const {
    Vec3 start = rotate(conjugate(s.rotation), s.angularVelocity), push = rotate(conjugate(s.rotation), torque) * dt;
    Vec3 w = start;
    for (int i = 0; i < 4; i++) {
      Vec3 Iw = mass_.inertia * w;
      Vec3 residual = mass_.inertia * (w - start) + cross(w, Iw) * dt - push;
      Mat3 slope = mass_.inertia + (crossMatrix(w) * mass_.inertia + crossMatrix(Iw) * -1.0) * dt;
      w -= inverse(slope) * residual;
    }
    return rotate(s.rotation, w);
  }

  RigidState velocityVerlet(const RigidState& s, double dt) const {
    return betweenHalfPushes(s, dt, [&](const Unknowns& y) {
      Quat middle = normalized(y.rotation + scaledBy(rate(y.rotation, spin(y.rotation, y.momentum)), 0.5 * dt));
      return normalized(quatFromRotationVector(spin(middle, y.momentum) * dt) * y.rotation);
    });
  }

  RigidState splitting(const RigidState& s, double dt) const {
    return betweenHalfPushes(s, dt, [&](const Unknowns& y) {
      return turnFreely(y.rotation, y.momentum, principalInertia(mass_.inertia), dt);
    });
  }

  RigidState rungeKutta4(const RigidState& s, double dt) const {
    Unknowns y = unknowns(s);
    Unknowns k1 = slope(y, 0), k2 = slope(along(y, k1, 0.5 * dt), 0.5 * dt),
             k3 = slope(along(y, k2, 0.5 * dt), 0.5 * dt), k4 = slope(along(y, k3, dt), dt);
    for (auto [k, share] : {std::pair{k1, 1.0}, {k2, 2.0}, {k3, 2.0}, {k4, 1.0}}) y = along(y, k, share * dt / 6);
    return state(y);
  }

 private:
  // Half a push, the way and the turn, half a push by the load at the end.
  template <class Turn> RigidState betweenHalfPushes(const RigidState& s, double dt, const Turn& turned) const {
    Unknowns y = unknowns(s);
    RigidLoad l = load(s, 0);
    y.velocity += acceleration(l) * (0.5 * dt);
    y.momentum += l.torque * (0.5 * dt);
    y.position += y.velocity * dt;
    y.rotation = turned(y);
    RigidLoad end = load(state(y), dt);
    y.velocity += acceleration(end) * (0.5 * dt);
    y.momentum += end.torque * (0.5 * dt);
    return state(y);
  }
  static Mat3 crossMatrix(Vec3 v) { return {{{0, -v.z, v.y}, {v.z, 0, -v.x}, {-v.y, v.x, 0}}}; }
  Unknowns slope(const Unknowns& y, double time) const {
    RigidState s = state(y);
    RigidLoad l = load(s, time);
    return {y.velocity, rate(s.rotation, s.angularVelocity), acceleration(l), l.torque};
  }
  static Unknowns along(const Unknowns& y, const Unknowns& k, double dt) {
    return {y.position + k.position * dt, y.rotation + scaledBy(k.rotation, dt), y.velocity + k.velocity * dt,
            y.momentum + k.momentum * dt};
  }

  RigidMass mass_;
  Mat3 invInertia_;
  const LoadFunction& load_;
};

}  // namespace

std::string_view integratorName(Integrator integrator) {
  constexpr std::string_view names[] = {"splitting",           "explicit_euler",
                                        "semi_implicit_euler", "implicit_euler_rotation",
                                        "velocity_verlet",     "runge_kutta_4"};
  static_assert(std::size(names) == kIntegratorCount);
  return names[std::size_t(integrator)];
}

RigidState integrated(Integrator integrator, const RigidState& state, const RigidMass& mass, const LoadFunction& load,
                      double dt) {
  Body body(mass, load);
  switch (integrator) {
    case Integrator::explicitEuler:
      return body.explicitEuler(state, dt);
    case Integrator::semiImplicitEuler:
      return body.semiImplicitEuler(state, dt, false);
    case Integrator::implicitEulerRotation:
      return body.semiImplicitEuler(state, dt, true);
    case Integrator::velocityVerlet:
      return body.velocityVerlet(state, dt);
    case Integrator::rungeKutta4:
      return body.rungeKutta4(state, dt);
    case Integrator::splitting:
      break;
  }
  return body.splitting(state, dt);
}

double kineticEnergy(const RigidState& state, const RigidMass& mass) {
  return 0.5 * mass.mass * lengthSquared(state.velocity) + 0.5 * dot(state.angularVelocity, spinMomentum(state, mass));
}

Vec3 spinMomentum(const RigidState& state, const RigidMass& mass) {
  return rotate(state.rotation, mass.inertia * rotate(conjugate(state.rotation), state.angularVelocity));
}

}  // namespace brickfall
