// A disc that spins on one end of its axle, as a gyroscope does, fell from 150 rad/s on at 1/60 s: its joint's arm was frozen
// while it turned by radians in a step.
#include <algorithm>
#include <cmath>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// A disc whose axle is level, 0.15 m from a ball joint, that goes round evenly by the formula of the fast top.
void goesRound(double around, double dt) {
  const double radius = 0.1, half = 0.02, arm = 0.15;
  World world = makeWorld();
  const BodyId post = add(world, bodyOf(boxOf({0.01, 0.01, 0.01}), {}, BodyType::fixed));
  BodyDef disc = bodyOf(cylinderOf(radius, half, 7800), {arm, 0, 0});
  disc.rotation = turn({0, 0, 1}, 90);
  const double spin = kG * arm / (0.5 * radius * radius * around);
  disc.angularVelocity = {spin, around, 0};
  disc.linearVelocity = {0, 0, -around * arm};
  JointDef ball;
  ball.bodyA = post;
  ball.bodyB = add(world, disc);
  EXPECT_TRUE(world.createJoint(ball).ok());
  double lowest = 0, gone = 0, last = 0;
  for (int i = 0; i < int(std::lround(2 / dt)) && !testing::Test::HasFailure(); i++) {
    stepSound(world, dt);
    const Vec3 at = world.state(ball.bodyB)->position;
    lowest = std::min(lowest, at.y);
    const double angle = std::atan2(-at.z, at.x);
    gone += std::remainder(angle - last, 2 * kPi);
    last = angle;
  }
  EXPECT_GT(lowest, -1e-3) << spin << " rad/s, " << dt << " s";
  EXPECT_NEAR(gone, 2 * around, 0.005 * 2 * around) << spin << " rad/s, " << dt << " s";
}

TEST(Regression, TopOnAJointFalls) {
  for (double around : {2.0, 1.0})  // rad/s: at spins of 147 and 294
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240}) goesRound(around, dt);
}

}  // namespace
}  // namespace brickfall
