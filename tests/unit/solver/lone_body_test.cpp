// One body on something fixed moves as if with the mean of its old and new velocity: what slides stops where it must.
#include <gtest/gtest.h>

#include <cmath>

#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kG;
using test::TestIsland;

// A brick that has come to rest on the ground, then gets a push.
struct Slider : TestIsland {
  // The brick first: the points of its contact ride with it.
  explicit Slider(double dt) : TestIsland(dt), body(brick({0, kBrick.y, 0})), face(touch(body, ground(), 0.4f)) {
    run(60);
    EXPECT_TRUE(island().resting());
    at(body).position.x = 0;
    island().unsettle();
  }
  BodyIndex body;
  ContactIndex face;
};

TEST(LoneBody, ASlideIsExactToSecondOrder) {
  const double v = 3, deceleration = 0.4 * kG;
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    Slider lab(dt);
    lab.at(lab.body).linearVelocity = {v, 0, 0};
    for (int step = 1; step <= int(0.3 / dt); step++) {
      lab.step();
      const double t = step * dt;
      EXPECT_NEAR(lab.at(lab.body).linearVelocity.x, v - deceleration * t, 8e-5) << dt;
      EXPECT_NEAR(lab.at(lab.body).position.x, v * t - 0.5 * deceleration * t * t, 1.3e-5)
          << dt << ": implicit Euler alone would fall short by " << 0.5 * deceleration * t * dt;
      EXPECT_NEAR(lab.at(lab.body).position.z, 0, 1e-7);
    }
  }
}

TEST(LoneBody, ASlideStopsWhereItMust) {
  for (double dt : {1.0 / 60, 1.0 / 240})
    for (double speed : {2.0, 0.1, 0.05}) {  // over many steps, two, and within one (at 1/60 s)
      Slider lab(dt);
      lab.at(lab.body).linearVelocity = {speed, 0, 0};
      for (int step = 0; step < int(2 / dt); step++) lab.step();
      EXPECT_TRUE(lab.island().resting()) << dt;
      const double way = speed * speed / (2 * 0.4 * kG);
      EXPECT_NEAR(lab.at(lab.body).position.x, way, 1e-4 * way + 1e-6) << dt << " from " << speed;
    }
}

TEST(LoneBody, WhatLandsIsNotCorrected) {
  TestIsland lab;
  BodyIndex body = lab.brick({0, kBrick.y + 1e-4, 0});
  lab.touch(body, lab.ground(), 0.4f);
  lab.at(body).linearVelocity = {1, -1, 0};
  lab.step();
  const SolvedMotion& s = lab.context.solved[body];
  EXPECT_NEAR(length(s.d - s.velocity * lab.context.dt), 0, 1e-12) << "plain implicit Euler";
  EXPECT_GT(std::fabs(s.velocity.y + 1), 0.1) << "it was stopped";
}

// A tall block tipped just past its balance on an edge: from rest on, its velocities are those of the end of each step, its turn that of
// their means. Exact is dw/dt = c sin(tilt).
TEST(LoneBody, AToppleIsExactToSecondOrder) {
  const Vec3 half{0.1, 0.4, 0.1};
  const double reach = std::hypot(half.x, half.y), inertia = 10.0 / 3 * reach * reach + 10 * reach * reach;
  for (double h : {1.0 / 60, 1.0 / 240}) {
    TestIsland lab(h);
    double tilt = 0.02, spin = 0;
    const Quat turn = quatFromAxisAngle({0, 0, 1}, std::atan(half.x / half.y) + tilt);
    const BodyIndex body = lab.brick({-std::sin(tilt) * reach, std::cos(tilt) * reach, 0}, 10, half, turn);
    lab.touch(body, lab.ground(), 0.9f);
    EXPECT_EQ(lab.contact(0).count, 2);
    lab.load(0, 10 * kG, 1e4 * lab.unit(0));
    double turned = 0;
    for (int step = 0; step < int(0.2 / h); step++) {
      for (int part = 0; part < 100; part++) {
        const double dt = h / 100, middle = tilt + 0.5 * dt * spin;
        const double change = dt * 10 * kG * reach / inertia * std::sin(middle);
        tilt += dt * (spin + 0.5 * change);
        spin += change;
      }
      lab.step();
      turned += lab.context.solved[body].th.z;
      EXPECT_NEAR(lab.at(body).angularVelocity.z, spin, 1e-2 * spin) << step << " of " << h;
      EXPECT_NEAR(turned, tilt - 0.02, 1e-2 * (tilt - 0.02)) << step << " of " << h;
    }
  }
}

}  // namespace
}  // namespace brickfall
