// Wheels that turned by more than a radian in a step left their axles, in the air as on the ground: a hinge held its axes
// across that of the other body, read a part of the spin as a turn of its own, and made its error larger in each step.
#include <algorithm>
#include <utility>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Cart {
  Cart(double speed, bool onGround) : world(onGround ? makeWorld() : emptySpace()) {
    if (onGround) addGround(world, 1);
    BodyDef chassis = bodyOf(boxOf({1.5, 0.3, 0.7}, 400), {0, 0.75, 0});
    chassis.linearVelocity = {speed, 0, 0};
    body = add(world, chassis);
    for (double x : {-1.0, 1.0})
      for (double z : {-0.85, 0.85}) {
        BodyDef wheel = bodyOf(cylinderOf(0.3, 0.1, 900, 1), {x, 0.3, z});
        wheel.rotation = turn({1, 0, 0}, 90);
        wheel.linearVelocity = {speed, 0, 0};
        wheel.angularVelocity = {0, 0, -speed / 0.3};
        JointDef axle;
        axle.type = JointType::revolute;
        axle.bodyA = body;
        axle.bodyB = add(world, wheel);
        // Either body may be the first of the joint.
        if (x < 0) std::swap(axle.bodyA, axle.bodyB);
        axle.anchor = wheel.position;
        axle.axis = {0, 0, 1};
        Result<JointId> made = world.createJoint(axle);
        EXPECT_TRUE(made.ok());
      }
  }
  World world;
  BodyId body;
};

TEST(Regression, WheelsLeaveTheirAxles) {
  for (bool onGround : {false, true})
    for (double speed : {20.0, 40.0})
      for (double dt : {1.0 / 60, 1.0 / 120}) {
        Cart cart(speed, onGround);
        double open = 0;
        for (int i = 0; i < int(std::lround(1 / dt)) && !HasFailure(); i++) {
          stepSound(cart.world, dt);
          for (JointId joint : cart.world.joints()) open = std::max(open, cart.world.state(joint)->turnError);
        }
        EXPECT_LT(open, 1e-6) << onGround << " " << speed << " m/s, " << dt << " s";
        EXPECT_NEAR(cart.world.state(cart.body)->linearVelocity.x, speed, 1e-3 * speed);
        EXPECT_NEAR(cart.world.state(cart.body)->position.y, 0.75, 1e-3);
      }
}

}  // namespace
}  // namespace brickfall
