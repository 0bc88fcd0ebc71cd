// Two balls of restitution 0.9 that met at less than 1 m/s, at the size of a brick, went on as one: that is the speed below which
// heaps do not chatter. A cradle of balls on hinges was no cradle: all swung on together.
#include <gtest/gtest.h>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

constexpr double kBallRadius = 0.0285;

double reboundOf(double speed, double gravity, double dt) {
  WorldDef def;
  def.gravity = {0, -gravity, 0};
  World world = makeWorld(def);
  ShapeDef ball = sphereOf(kBallRadius, 1700, 0);
  ball.material.restitution = 0.9;
  BodyDef first = bodyOf(ball, {});
  first.linearVelocity = {speed, 0, 0};
  const BodyId a = add(world, first), b = add(world, bodyOf(ball, {2 * kBallRadius + 0.003, 0, 0}));
  for (double t = 0; t < 0.003 / speed + 0.2; t += dt) EXPECT_TRUE(world.step(dt).ok());
  return (world.state(b)->linearVelocity.x - world.state(a)->linearVelocity.x) / speed;
}

TEST(Regression, SlowBallsStick) {
  for (double gravity : {0.0, 9.81})
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
      for (double speed : {0.02, 0.1, 0.3, 0.8, 1.2, 3.0})
        EXPECT_NEAR(reboundOf(speed, gravity, dt), 0.9, 0.01) << speed << " m/s, g " << gravity << ", step " << dt;
}

// Balls on hinges, a hair apart: as many come as go, with their speed.
TEST(Regression, CradleSwingsAsOne) {
  const double arm = 0.6, lifted = 0.3, gap = 1e-4;  // m, rad, m: they meet at 0.73 m/s
  for (int balls : {2, 5, 9})
    for (int come : {1, 2})
      for (double dt : {1.0 / 60, 1.0 / 120}) {
        if (come >= balls) continue;
        World world = makeWorld();
        const BodyId frame = add(world, bodyOf(sphereOf(0.02), {0, 0.5, 0}, BodyType::fixed));
        std::vector<BodyId> all;
        auto foot = [&](int i) { return i * (2 * kBallRadius + gap); };
        for (int i = 0; i < balls; i++) {
          ShapeDef ball = sphereOf(kBallRadius, 8000, 0);
          ball.material.restitution = 1;
          const double angle = i < come ? lifted : 0;
          BodyDef def = bodyOf(ball, {foot(i) - arm * std::sin(angle), -arm * std::cos(angle), 0});
          def.rotation = quatFromRotationVector({0, 0, -angle});
          all.push_back(add(world, def));
          JointDef hinge;
          hinge.type = JointType::revolute;
          hinge.bodyA = frame;
          hinge.bodyB = all.back();
          hinge.anchor = {foot(i), 0, 0};
          hinge.axis = {0, 0, 1};
          ASSERT_TRUE(world.createJoint(hinge).ok());
        }
        double last = 0, stays = 0;
        for (double t = 0; t < 0.8; t += dt) {  // half a period
          ASSERT_TRUE(world.step(dt).ok());
          auto swung = [&](int i) { return (world.state(all[std::size_t(i)])->position.x - foot(i)) / arm; };
          last = std::max(last, std::asin(std::min(1.0, swung(balls - 1))));
          if (t > 0.6) stays = std::max(stays, std::fabs(swung(0)));
        }
        const std::string name =
            std::to_string(balls) + " balls, " + std::to_string(come) + " come, step " + std::to_string(dt);
        EXPECT_NEAR(last, lifted, 0.01 * lifted) << name;
        EXPECT_LT(stays, 0.05 * lifted) << name;
      }
}

}  // namespace
}  // namespace brickfall
