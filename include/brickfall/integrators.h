// Ways to carry a rigid body through a time step, to be compared: usable without a World, and a setting of it.
#pragma once
#include <cstdint>
#include <functional>
#include <string_view>

#include "brickfall/math.h"

namespace brickfall {

// How free motion goes on. `splitting` is the engine's own; the others show what they do to energy (docs/integrators.md).
enum class Integrator : std::uint8_t {
  splitting,              // half a push, the way, half a push; torque-free turns split about the principal axes
  explicitEuler,          // old velocities move the body; first order, gains energy
  semiImplicitEuler,      // new velocities move the body; first order, linear part keeps energy near its value
  implicitEulerRotation,  // as semiImplicitEuler, but the gyroscopic torque at the end of the step: spins lose energy
  velocityVerlet,         // half a push, the way, half a push; second order
  rungeKutta4,            // four evaluations; fourth order, loses a little
};
constexpr int kIntegratorCount = 6;
// "splitting", "explicit_euler", "semi_implicit_euler", "implicit_euler_rotation", "velocity_verlet", "runge_kutta_4"
std::string_view integratorName(Integrator integrator);

struct RigidState {
  Vec3 position;         // m, centre of mass
  Quat rotation;         // unit
  Vec3 velocity;         // m/s
  Vec3 angularVelocity;  // rad/s, world axes
};

// What does not change: mass > 0 in kg, inertia about the centre of mass in body axes in kg m2 (regular, symmetric).
struct RigidMass {
  double mass = 1;
  Mat3 inertia;
};

// At the centre of mass, world axes.
struct RigidLoad {
  Vec3 force;   // N
  Vec3 torque;  // N m
};
// The load in a state, `time` s after the start of the step.
using LoadFunction = std::function<RigidLoad(const RigidState& state, double time)>;

// The state dt seconds later. Calls `load` once (Euler methods), twice (splitting, velocityVerlet) or four times.
// Loads may depend on velocities; the symplectic methods then lose some of their order.
RigidState integrated(Integrator integrator, const RigidState& state, const RigidMass& mass, const LoadFunction& load,
                      double dt);

// Kinetic energy, J, and angular momentum about the centre of mass, kg m2/s, world axes.
double kineticEnergy(const RigidState& state, const RigidMass& mass);
Vec3 spinMomentum(const RigidState& state, const RigidMass& mass);

}  // namespace brickfall
