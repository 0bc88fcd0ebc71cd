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
    lab.step();  // its first step of sliding: the friction of points that stuck builds up
    double x0 = lab.at(lab.body).position.x, v0 = lab.at(lab.body).linearVelocity.x;
    int steps = int(0.3 / dt);
    for (int step = 0; step < steps; step++) lab.step();
    double t = steps * dt;
    EXPECT_NEAR(lab.at(lab.body).linearVelocity.x, v0 - deceleration * t, 7e-5) << dt;
    EXPECT_NEAR(lab.at(lab.body).position.x, x0 + v0 * t - 0.5 * deceleration * t * t, 1e-5)
        << dt << ": implicit Euler alone would fall short by " << 0.5 * deceleration * t * dt;
    EXPECT_NEAR(lab.at(lab.body).position.z, 0, 1e-7);
  }
}

TEST(LoneBody, ASlideStopsWhereItMust) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    Slider lab(dt);
    lab.at(lab.body).linearVelocity = {2, 0, 0};
    for (int step = 0; step < int(2 / dt); step++) lab.step();
    EXPECT_TRUE(lab.island().resting()) << dt;
    double way = 2 * 2 / (2 * 0.4 * kG);
    EXPECT_NEAR(lab.at(lab.body).position.x, way, 0.25 * 0.4 * kG * dt * dt + 2e-4)
        << "within its last step, and the anchors' give";
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

// A tall block tipped just past its balance on an edge: its first step from rest gets half its change, so that the velocity is
// that of the middle of the step.
TEST(LoneBody, TheFirstStepOfAToppleGetsHalfItsChange) {
  Vec3 half{0.1, 0.4, 0.1};
  double tilt = std::atan(half.x / half.y) + 0.02, reach = std::hypot(half.x, half.y);
  auto block = [&](TestIsland& lab) {
    Quat turn = quatFromAxisAngle({0, 0, 1}, tilt);
    double beyond = std::sin(0.02) * reach;  // the edge stands at x = beyond of the centre
    BodyIndex body = lab.brick({-beyond, std::cos(0.02) * reach, 0}, 10, half, turn);
    lab.touch(body, lab.ground(), 0.9f);
    return body;
  };
  double h = 1.0 / 240, inertia = 10.0 / 3 * (half.x * half.x + half.y * half.y) + 10 * reach * reach;
  double acceleration = 10 * kG * reach * std::sin(0.02) / inertia;
  TestIsland lab(h);
  BodyIndex body = block(lab);
  for (Contact& c : lab.contacts.contacts) EXPECT_EQ(c.count, 2);
  lab.load(0, 10 * kG, 1e4 * lab.unit(0));
  lab.step();
  EXPECT_NEAR(lab.at(body).angularVelocity.z, 0.5 * acceleration * h, 0.02 * 0.5 * acceleration * h);
}

}  // namespace
}  // namespace brickfall
