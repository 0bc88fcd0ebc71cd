// Where a body goes if nothing touches it: closed forms of damping, drag and free turns.
#include "solver/free_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kBrickMass;
using test::kG;
using test::TestIsland;

struct Alone : TestIsland {
  explicit Alone(double dt = 1.0 / 60) : TestIsland(dt), body(brick({})) {
    link();
    context.gravity = {};
    context.airDensity = 1.2;
  }
  const FreeMotion& predict(bool hasContacts = false) {
    predictFreeMotion(context, bodies, body, context.dt, hasContacts);
    return context.free[body];
  }
  BodyIndex body;
};

TEST(FreeMotion, ForcesAndGravityActForTheWholeStep) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    Alone lab(dt);
    lab.context.gravity = {0, -kG, 0};
    lab.bodies.data[lab.body].gravityScale = 0.5;
    lab.bodies.data[lab.body].force = {0, 0, 27};
    lab.at(lab.body).linearVelocity = {3, 0, 0};
    const FreeMotion& free = lab.predict();
    Vec3 end{3, -0.5 * kG * dt, 10 * dt};
    EXPECT_NEAR(length(free.d - end * dt), 0, 1e-15);
    EXPECT_NEAR(length(free.way - (end + Vec3{3, 0, 0}) * (0.5 * dt)), 0, 1e-15) << "the mean of both velocities";
    EXPECT_EQ(free.startVelocity, (Vec3{3, 0, 0}));
  }
}

TEST(FreeMotion, DampingIsTheExponentialHoweverStrong) {
  for (double rate : {0.01, 1.0, 30.0, 600.0}) {
    Alone lab;
    lab.bodies.data[lab.body].linearDamping = rate;
    lab.bodies.data[lab.body].angularDamping = 2 * rate;
    lab.at(lab.body).linearVelocity = {5, 0, 0};
    lab.at(lab.body).angularVelocity = {0, 3, 0};
    lab.predict();
    for (auto [found, start, x] : {std::tuple{lab.at(lab.body).linearVelocity.x, 5.0, rate / 60},
                                   std::tuple{lab.at(lab.body).angularVelocity.y, 3.0, 2 * rate / 60}}) {
      double part = x;  // the approximation leaves out part^5 / 720 of each part
      while (part > 0.5) part /= 2;
      double wanted = start * std::exp(-x);
      EXPECT_NEAR(found, wanted, (1.1 * x / part * std::pow(part, 5) / 720 + 1e-14) * wanted) << x;
    }
    EXPECT_EQ(lab.context.free[lab.body].startVelocity.x, 5) << "as it was before";
  }
}

TEST(FreeMotion, DragIsExactHoweverLongTheStep) {
  for (double dt : {1.0 / 240, 1.0 / 60, 1.0, 100.0}) {
    Alone lab(dt);
    lab.bodies.data[lab.body].dragArea = 0.02;
    lab.at(lab.body).linearVelocity = {0, -40, 0};
    lab.predict();
    double c = 0.5 * 1.2 * 0.02 / kBrickMass;
    EXPECT_NEAR(lab.at(lab.body).linearVelocity.y, -40 / (1 + c * 40 * dt), 1e-12) << dt;
  }
  // Falling at its last speed, sqrt(g / c), it keeps it to second order.
  double error[2];
  for (int i : {0, 1}) {
    Alone lab(i == 0 ? 0.2 : 0.1);
    lab.context.gravity = {0, -kG, 0};
    lab.bodies.data[lab.body].dragArea = 0.02;
    double last = std::sqrt(kG / (0.5 * 1.2 * 0.02 / kBrickMass));
    lab.at(lab.body).linearVelocity = {0, -last, 0};
    error[i] = std::fabs(lab.predict().d.y / lab.context.dt + last);
    EXPECT_LT(error[i], 0.02 * kG * lab.context.dt);
  }
  EXPECT_LT(error[1], error[0] / 3.5);
}

TEST(FreeMotion, AFreeTurnKeepsEnergyAndAngularMomentum) {
  Alone lab;
  lab.at(lab.body).angularVelocity = {20, 3, 40};
  double energy = lab.bodies.kineticEnergy(lab.body);
  Vec3 momentum = lab.bodies.worldInertia(lab.body) * lab.at(lab.body).angularVelocity;
  for (int step = 0; step < 200; step++) {
    const FreeMotion& free = lab.predict();
    ASSERT_NEAR(length(free.angularMomentum - momentum), 0, 1e-12 * length(momentum));
    lab.bodies.setRotation(lab.body, free.rotation);
    lab.at(lab.body).angularVelocity = lab.bodies.worldInvInertia(lab.body) * momentum;
    ASSERT_NEAR(lab.bodies.kineticEnergy(lab.body), energy, 1e-4 * energy) << "step " << step;
  }
  lab.bodies.data[lab.body].torque = {0, 0.3, 0};
  EXPECT_NEAR(length(lab.predict().angularMomentum - momentum - Vec3{0, 0.3 / 60, 0}), 0, 1e-12);
}

TEST(FreeMotion, TheSolveSeesAtMostHalfARadian) {
  for (double spin : {29.0, 31.0, 300.0}) {
    Alone lab;
    lab.at(lab.body).angularVelocity = {0, spin, 0};
    Vec3 momentum = lab.bodies.worldInertia(lab.body) * Vec3{0, spin, 0};
    EXPECT_FALSE(lab.predict(false).turnsFaster) << "nothing touches it";
    const FreeMotion& free = lab.predict(true);
    EXPECT_EQ(free.turnsFaster, spin > 30);
    EXPECT_NEAR(free.th.y, std::min(0.5, spin / 60), 1e-12);
    EXPECT_NEAR(length(free.angularMomentum - momentum), 0, 1e-15) << "its momentum stays";
  }
}

TEST(FreeMotion, WhatLooksTheSameWhenItTurnsIsNotLimited) {
  Alone roller;
  roller.bodies.mass[roller.body].symmetryAxis = {1, 0, 0};
  roller.at(roller.body).angularVelocity = {300, 0, 0};
  EXPECT_NEAR(length(roller.predict(true).th - Vec3{5, 0, 0}), 0, 1e-12);
  EXPECT_FALSE(roller.context.free[roller.body].turnsFaster);
  roller.bodies.setRotation(roller.body, quatFromAxisAngle({0, 1, 0}, 0.3));
  const BodyMass& mass = roller.bodies.mass[roller.body];
  Vec3 axis{std::cos(0.3), 0, -std::sin(0.3)}, across{0, 2, 0};
  EXPECT_NEAR(length(visibleTurn(mass, roller.at(roller.body).orientation, axis * 7.0 + across) - across), 0, 1e-12);
  roller.bodies.mass[roller.body].round = true;
  EXPECT_EQ(visibleTurn(mass, {}, {1, 2, 3}), Vec3{});
}

TEST(FreeMotion, AShortenedTurnLiesOnTheWayOfTheWholeOne) {
  Alone lab;
  lab.at(lab.body).angularVelocity = {20, 3, 40};
  Vec3 momentum = lab.predict().angularMomentum;
  shortenFreeTurn(lab.context, lab.body, 0.25);
  const FreeMotion cut = lab.context.free[lab.body];
  EXPECT_NEAR(cut.turnTime, 0.25 / 60, 1e-15);
  EXPECT_EQ(cut.angularMomentum, momentum);
  Alone shorter(0.25 / 60);
  shorter.at(shorter.body).angularVelocity = {20, 3, 40};
  Quat there = shorter.predict().rotation * conjugate(cut.rotation);
  EXPECT_NEAR(length(Vec3{there.x, there.y, there.z}), 0, 1e-6);
}

}  // namespace
}  // namespace brickfall
