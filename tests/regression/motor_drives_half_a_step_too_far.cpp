// What a motor drove with all of its strength went on as if it had begun half a step earlier: a lift rose by 0.08 m/s more
// than its velocity said, and a car lost 2 % of its speed at 1/60 s.
#include <algorithm>
#include <cmath>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// `share`: of its weight.
void lifts(double share, double dt) {
  World world = makeWorld();
  JointDef slide;
  slide.type = JointType::prismatic;
  slide.bodyA = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 50, 0}, BodyType::fixed));
  slide.bodyB = add(world, bodyOf(boxOf({0.5, 0.5, 0.5}, 2000), {0, 30, 0}));
  slide.anchor = {0, 30, 0};
  slide.motor = JointDef::Motor{100, 2000 * kG * share};
  ASSERT_TRUE(world.createJoint(slide).ok());
  run(world, 1, dt);
  const double a = (share - 1) * kG;
  EXPECT_NEAR(world.state(slide.bodyB)->linearVelocity.y, a, 1e-4 * kG) << share << " at " << dt;
  EXPECT_NEAR(world.state(slide.bodyB)->position.y - 30, a / 2, 1e-4 * kG) << share << " at " << dt;
}

// It reaches its speed without passing it, whatever its strength.
void reachesItsSpeed(double strength, double dt) {
  World world = makeWorld();
  JointDef slide;
  slide.type = JointType::prismatic;
  slide.bodyA = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 50, 0}, BodyType::fixed));
  slide.bodyB = add(world, bodyOf(boxOf({0.5, 0.5, 0.5}, 2000), {0, 30, 0}));
  slide.anchor = {0, 30, 0};
  slide.motor = JointDef::Motor{1, 2000 * kG * strength};
  ASSERT_TRUE(world.createJoint(slide).ok());
  double fastest = 0;
  for (int i = 0; i < int(std::lround(1 / dt)); i++) {
    stepSound(world, dt);
    fastest = std::max(fastest, world.state(slide.bodyB)->linearVelocity.y);
  }
  EXPECT_NEAR(fastest, 1, 2e-3) << strength << " at " << dt;
  EXPECT_NEAR(world.state(slide.bodyB)->linearVelocity.y, 1, 1e-3) << strength << " at " << dt;
}

void driven(double torque, double dt) {
  World world = makeWorld();
  addGround(world, 1);
  const BodyId chassis = add(world, bodyOf(boxOf({1.5, 0.3, 0.7}, 400), {0, 0.75, 0}));
  const double radius = 0.3;
  double inertia = world.state(chassis)->mass;
  for (double x : {-1.0, 1.0})
    for (double z : {-0.85, 0.85}) {
      BodyDef wheel = bodyOf(cylinderOf(radius, 0.1, 900, 1), {x, radius, z});
      wheel.rotation = turn({1, 0, 0}, 90);
      JointDef axle;
      axle.type = JointType::revolute;
      axle.bodyA = chassis;
      axle.bodyB = add(world, wheel);
      axle.anchor = wheel.position;
      axle.axis = {0, 0, 1};
      axle.motor = JointDef::Motor{-1000, torque};
      ASSERT_TRUE(world.createJoint(axle).ok());
      inertia += 1.5 * world.state(axle.bodyB)->mass;
    }
  run(world, 2, dt);
  const double a = 4 * torque / radius / inertia;
  EXPECT_NEAR(world.state(chassis)->linearVelocity.x, 2 * a, 1e-3 * 2 * a) << torque << " N m at " << dt;
  EXPECT_NEAR(world.state(chassis)->position.x, 2 * a, 1e-3 * 2 * a) << torque << " N m at " << dt;
}

TEST(Regression, MotorDrivesHalfAStepTooFar) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    for (double share : {0.5, 0.97, 1.03, 2.0}) lifts(share, dt);
    for (double strength : {1.2, 3.0, 100.0}) reachesItsSpeed(strength, dt);
    for (double torque : {20.0, 80.0}) driven(torque, dt);
  }
}

}  // namespace
}  // namespace brickfall
