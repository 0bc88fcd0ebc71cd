// Each integrator's order, and what it does to the energy of a pendulum and of a body that spins freely.
#include "brickfall/integrators.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brickfall {
namespace {

constexpr double kG = 9.81;

// A bob of 1 kg on a spring of 1 m and 400 N/m about the origin: an elastic pendulum, with a potential.
constexpr double kSpring = 400;
RigidLoad pendulumLoad(const RigidState& s, double) {
  double l = length(s.position);
  return {Vec3{0, -kG, 0} - s.position * (kSpring * (l - 1) / l), {}};
}
RigidState pendulum(double angle) {
  double l = 1 + kG / kSpring;
  return {{l * std::sin(angle), -l * std::cos(angle), 0}, {}, {}, {}};
}
// Above the lowest it can have.
double pendulumEnergy(const RigidState& s) {
  double stretch = length(s.position) - 1;
  return 0.5 * lengthSquared(s.velocity) + kG * (s.position.y + 1) + 0.5 * kSpring * stretch * stretch +
         0.5 * kG * kG / kSpring;
}

RigidMass boxMass() { return {1, diagonal(Vec3{0.05, 0.10, 0.13} * (1.0 / 12))}; }  // 0.3 x 0.2 x 0.1 m
RigidLoad noLoad(const RigidState&, double) { return {}; }

const Integrator kAll[] = {Integrator::splitting,         Integrator::explicitEuler,
                           Integrator::semiImplicitEuler, Integrator::implicitEulerRotation,
                           Integrator::velocityVerlet,    Integrator::rungeKutta4};

// Relative change of kinetic energy of a tumbling box in 5 s.
double spinEnergyChange(Integrator integrator, double dt) {
  RigidState s;
  s.angularVelocity = {0.1, 10, 0.05};
  double start = kineticEnergy(s, boxMass());
  for (int i = 0; i < std::lround(5 / dt); i++) s = integrated(integrator, s, boxMass(), noLoad, dt);
  return kineticEnergy(s, boxMass()) / start - 1;
}

double pendulumEnergyChange(Integrator integrator, double dt, double seconds = 10) {
  RigidState s = pendulum(0.5);
  double start = pendulumEnergy(s);
  for (int i = 0; i < std::lround(seconds / dt); i++)
    s = integrated(integrator, s, {1, diagonal(Vec3{1, 1, 1})}, pendulumLoad, dt);
  return pendulumEnergy(s) / start - 1;
}

TEST(Integrators, HaveTheOrderThatTheyPromise) {
  // A ball on a spring of 1 rad/s for 1 s: x = cos t.
  auto error = [](Integrator integrator, int steps) {
    RigidState s;
    s.position = {1, 0, 0};
    LoadFunction spring = [](const RigidState& state, double) { return RigidLoad{-state.position, {}}; };
    for (int i = 0; i < steps; i++) s = integrated(integrator, s, {1, diagonal(Vec3{1, 1, 1})}, spring, 1.0 / steps);
    return std::fabs(s.position.x - std::cos(1.0));
  };
  for (Integrator integrator : kAll) {
    double order = std::log2(error(integrator, 20) / error(integrator, 40));
    bool second = integrator == Integrator::splitting || integrator == Integrator::velocityVerlet;
    double expected = integrator == Integrator::rungeKutta4 ? 4 : second ? 2 : 1;
    EXPECT_NEAR(order, expected, 0.15) << integratorName(integrator);
  }
}

TEST(Integrators, ExplicitEulerFeedsAPendulumAndTheOthersHardlyDo) {
  EXPECT_GT(pendulumEnergyChange(Integrator::explicitEuler, 1.0 / 240), 0.5);
  EXPECT_LT(std::fabs(pendulumEnergyChange(Integrator::semiImplicitEuler, 1.0 / 240)), 0.1);
  EXPECT_LT(std::fabs(pendulumEnergyChange(Integrator::velocityVerlet, 1.0 / 240)), 0.01);
  double rungeKutta = pendulumEnergyChange(Integrator::rungeKutta4, 1.0 / 240);
  EXPECT_LT(rungeKutta, 0);
  EXPECT_GT(rungeKutta, -0.01);
}

TEST(Integrators, SpinsGainLoseOrKeepEnergyAsTheyMust) {
  EXPECT_GT(std::fabs(spinEnergyChange(Integrator::explicitEuler, 1.0 / 60)), 0.01);
  EXPECT_LT(spinEnergyChange(Integrator::implicitEulerRotation, 1.0 / 60), -0.001);
  EXPECT_LT(std::fabs(spinEnergyChange(Integrator::splitting, 1.0 / 60)), 1e-5);
  EXPECT_LT(std::fabs(spinEnergyChange(Integrator::rungeKutta4, 1.0 / 60)), 1e-3);
}

TEST(Integrators, MomentumOfAFreeSpinStaysWhereItIsTheUnknown) {
  for (Integrator integrator : {Integrator::splitting, Integrator::velocityVerlet, Integrator::rungeKutta4}) {
    RigidState s;
    s.angularVelocity = {1, 10, 3};
    Vec3 start = spinMomentum(s, boxMass());
    for (int i = 0; i < 600; i++) s = integrated(integrator, s, boxMass(), noLoad, 1.0 / 60);
    EXPECT_LT(length(spinMomentum(s, boxMass()) - start), 1e-12) << integratorName(integrator);
  }
}

TEST(Integrators, EachIsItsOwn) {
  for (int i = 0; i < kIntegratorCount; i++)
    for (int j = 0; j < i; j++) {
      EXPECT_NE(integratorName(Integrator(i)), integratorName(Integrator(j)));
      EXPECT_NE(spinEnergyChange(Integrator(i), 1.0 / 60), spinEnergyChange(Integrator(j), 1.0 / 60)) << i << " " << j;
    }
}

}  // namespace
}  // namespace brickfall
