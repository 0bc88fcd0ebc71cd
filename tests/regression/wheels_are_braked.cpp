// A cart whose wheels turned by more than 0.3 rad in a step was braked to a third of its speed: what keeps the arms of
// flung links from turning too far in a step took from the turn of wheels, which swing no arm.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// How far it rolls in 2 s, of what it would. `hub`: m, from the middle of a wheel along its axle to the hinge.
double rolled(double speed, double hub, double dt) {
  const double radius = 0.2;
  World world = makeWorld();
  addGround(world, 0.9);
  BodyDef board = bodyOf(boxOf({0.6, 0.05, 0.3}, 500), {0, 0.3, 0});
  board.linearVelocity = {speed, 0, 0};
  const BodyId cart = add(world, board);
  for (double x : {-0.45, 0.45})
    for (double side : {-1.0, 1.0}) {
      BodyDef wheel = bodyOf(cylinderOf(radius, 0.04, 2000, 0.9), {x, radius, 0.4 * side});
      wheel.rotation = turn({1, 0, 0}, 90);
      wheel.linearVelocity = {speed, 0, 0};
      wheel.angularVelocity = {0, 0, -speed / radius};
      JointDef hinge;
      hinge.type = JointType::revolute;
      hinge.axis = {0, 0, 1};
      hinge.anchor = {x, radius, (0.4 - hub) * side};
      hinge.bodyA = cart;
      hinge.bodyB = add(world, wheel);
      EXPECT_TRUE(world.createJoint(hinge).ok());
    }
  run(world, 2, dt);
  return world.state(cart)->position.x / (2 * speed);
}

TEST(Regression, WheelsAreBraked) {
  for (double hub : {0.0, 0.06}) {
    EXPECT_NEAR(rolled(4, hub, 1.0 / 30), 1, 0.005);
    EXPECT_NEAR(rolled(4, hub, 1.0 / 60), 1, 0.005);
    EXPECT_NEAR(rolled(10, hub, 1.0 / 60), 1, 0.005);
    EXPECT_NEAR(rolled(10, hub, 1.0 / 120), 1, 0.005);
  }
}

}  // namespace
}  // namespace brickfall
