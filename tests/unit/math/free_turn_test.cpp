// The torque-free turn: angular momentum to rounding, energy to fourth order, the Dzhanibekov flip, whatever the axes.
#include "math/free_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "math/random.h"

namespace brickfall {
namespace {

// Inertia with its principal axes turned away from the body's.
Mat3 turnedInertia(Vec3 principal, Quat axes) {
  Mat3 r = toMatrix(axes);
  return r * diagonal(principal) * transpose(r);
}

double energy(const Mat3& inverse, Quat q, Vec3 momentum) {
  Vec3 body = rotate(conjugate(q), momentum);
  return 0.5 * dot(body, inverse * body);
}

TEST(TurnFreely, SpinsUniformlyAboutAPrincipalAxis) {
  PrincipalInertia mass = principalInertia(diagonal(Vec3{2, 3, 5}));
  Quat q;
  for (int i = 0; i < 60; i++) q = turnFreely(q, {0, 0, 10}, mass, 1.0 / 60);  // 2 rad/s
  Vec3 turned = rotationVector(normalized(q));
  EXPECT_NEAR(turned.x, 0, 1e-12);
  EXPECT_NEAR(turned.y, 0, 1e-12);
  EXPECT_NEAR(turned.z, 2, 1e-9);
}

TEST(TurnFreely, KeepsEnergyAndFlipsInTimeWhateverTheAxes) {
  // Box 0.3 x 0.2 x 0.1 of 1 kg: flips every 2.4345 s.
  Vec3 principal{(0.04 + 0.01) / 12, (0.09 + 0.01) / 12, (0.09 + 0.04) / 12};
  for (Quat axes : {Quat{}, quatFromAxisAngle(normalized(Vec3{1, 2, 3}), 0.7)}) {
    Mat3 inertia = turnedInertia(principal, axes), inverseInertia = inverse(inertia);
    PrincipalInertia mass = principalInertia(inertia);
    Vec3 spin = rotate(axes, Vec3{0.1, 0, 0}) + rotate(axes, Vec3{0, 10, 0});
    Vec3 momentum = inertia * spin;
    Quat q;
    double start = energy(inverseInertia, q, momentum), drift = 0, previous = 1, dt = 1.0 / 120;
    std::vector<double> flips;
    for (int i = 1; i <= 60 / dt; i++) {
      q = turnFreely(q, momentum, mass, dt);
      drift = std::max(drift, std::fabs(energy(inverseInertia, q, momentum) - start) / start);
      Vec3 w = inverseInertia * rotate(conjugate(q), momentum);
      double along = dot(rotate(axes, Vec3{0, 1, 0}), w);
      if ((along > 0) != (previous > 0))
        flips.push_back(i * dt - dt * std::fabs(along) / (std::fabs(along) + std::fabs(previous)));
      previous = along;
    }
    EXPECT_LT(drift, 1e-5);
    ASSERT_GE(flips.size(), 20u);
    // The time between flips hangs on the logarithm of the energy's distance from the separatrix: a small error shows.
    EXPECT_NEAR((flips[20 - 1] - flips[0]) / 19, 2.4345, 0.003);
  }
}

TEST(TurnFreely, EnergyErrorFallsWithTheFourthPowerOfTheStep) {
  Mat3 inertia = turnedInertia({1, 2, 3}, quatFromAxisAngle(normalized(Vec3{3, 1, 2}), 1.1));
  Mat3 inverseInertia = inverse(inertia);
  PrincipalInertia mass = principalInertia(inertia);
  Vec3 momentum{0.066, 0.12, 0.18};  // so slow that one substep is taken per call
  double error[2];
  for (int n = 0; n < 2; n++) {
    double dt = n == 0 ? 0.5 : 0.25;
    Quat q;
    double start = energy(inverseInertia, q, momentum), worst = 0;
    for (int i = 0; i < 400 / dt; i++) {
      q = turnFreely(q, momentum, mass, dt);
      worst = std::max(worst, std::fabs(energy(inverseInertia, q, momentum) / start - 1));
    }
    error[n] = worst;
  }
  EXPECT_GT(error[0] / error[1], 12);
  EXPECT_LT(error[0] / error[1], 20);
}

// A pebble of 2 mg that was hit at 767 m/s spun by 100,000 rad in a step, 25 rad in a substep, and gained energy with each step.
TEST(TurnFreely, KeepsEnergyAtAnySpeed) {
  const Mat3 inertia = turnedInertia({1, 2, 3}, quatFromAxisAngle(normalized(Vec3{3, 1, 2}), 1.1));
  const Mat3 inverseInertia = inverse(inertia);
  const PrincipalInertia mass = principalInertia(inertia);
  for (double speed : {1.0, 1e3, 1e5, 1e7}) {
    const Vec3 momentum = Vec3{0.66, 1.2, 1.8} * speed;
    Quat q;
    const double start = energy(inverseInertia, q, momentum);
    for (int i = 0; i < 20; i++) {
      q = turnFreely(q, momentum, mass, 1);
      EXPECT_NEAR(energy(inverseInertia, q, momentum) / start, 1, 1e-5) << speed;
    }
  }
}

TEST(TurnFreely, AnySpeedStaysAUnitQuaternion) {
  PrincipalInertia mass = principalInertia(diagonal(Vec3{1, 0.5, 0.25}));
  for (double speed : {0.0, 1e-9, 1.0, 1e3, 1e6}) {
    Quat q;
    for (int i = 0; i < 20; i++) q = turnFreely(q, {speed, speed * 0.5, -speed}, mass, 0.1);
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-12) << speed;
  }
}

// Whatever is beside what: slow and fast, about one axis, not at all, too fast for a substep, not finite.
TEST(TurnFreely, SideBySideGivesTheSameBitsAsAlone) {
  Random random(7);
  auto any = [&](double size) { return (2 * random.unit() - 1) * size; };
  int slow = 0, fast = 0, spinning = 0;
  for (int trial = 0; trial < 20000; trial++) {
    FreeTurn turns[kTurnsAtOnce];
    const int count = 1 + trial % kTurnsAtOnce;
    const double dt = trial % 3 ? 1.0 / 60 : 1.0 / 240;
    Quat alone[kTurnsAtOnce];
    for (int n = 0; n < count; n++) {
      FreeTurn& t = turns[n];
      const int kind = int(random.unit() * 10);
      const double speed = kind < 4 ? 1e-3 : kind < 7 ? 1 : kind == 7 ? 100 : kind == 8 ? 1e-70 : 5;
      slow += speed == 1e-3;
      fast += speed == 1;
      spinning += speed == 5;
      t.rotation = kind == 9 ? Quat{} : normalized(Quat{any(1), any(1), any(1), any(1)});
      t.inertia = {kind == 9 ? Mat3{} : toMatrix(normalized(Quat{any(1), any(1), any(1), any(1)})),
                   {1 + random.unit(), 1 + 3 * random.unit(), 2 + random.unit()}};
      t.angularMomentum = {any(speed), any(speed), any(speed)};
      if (kind == 9) t.angularMomentum[trial % 3] = trial % 2 ? 0.0 : -0.0;
      if (kind == 9 && trial % 100 == 0) t.angularMomentum.x = INFINITY;
      alone[n] = turnFreely(t.rotation, t.angularMomentum, t.inertia, dt);
    }
    turnFreely(turns, count, dt);
    for (int n = 0; n < count; n++)
      ASSERT_EQ(std::memcmp(&turns[n].rotation, &alone[n], sizeof alone[n]), 0) << "trial " << trial << " lane " << n;
  }
  EXPECT_GT(slow, 1000);
  EXPECT_GT(fast, 1000);
  EXPECT_GT(spinning, 1000) << "of several substeps";
}

}  // namespace
}  // namespace brickfall
