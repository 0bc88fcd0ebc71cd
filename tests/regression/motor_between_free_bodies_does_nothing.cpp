// Two bodies in the air with a motor between them stood still: all that the motor gave was taken back by the last check, which
// knew of springs that give, not of motors.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

JointId joined(World& world, JointType type, JointDef::Motor motor) {
  BodyDef low = bodyOf(cylinderOf(0.5, 0.05), {}), high = bodyOf(cylinderOf(0.3, 0.1, 3000), {0, 0.2, 0});
  JointDef def;
  def.type = type;
  def.bodyA = add(world, low);
  def.bodyB = add(world, high);
  def.anchor = {0, 0.1, 0};
  def.motor = motor;
  return world.createJoint(def).value();
}

// Until the speed is reached it grows by strength over the inertia of both; no momentum comes of it.
TEST(Regression, MotorBetweenFreeBodiesDoesNothing) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (double gravity : {0.0, -9.81}) {
      WorldDef def;
      def.gravity = {0, gravity, 0};
      World turning = makeWorld(def), sliding = makeWorld(def);
      const JointId hinge = joined(turning, JointType::revolute, {10, 20}),
                    slide = joined(sliding, JointType::prismatic, {0.5, 30});
      const std::vector<BodyId> turned = turning.bodies(), slid = sliding.bodies();
      const double inertia = 1 / (1 / turning.massProperties(turned[0])->inertia.row[1].y +
                                  1 / turning.massProperties(turned[1])->inertia.row[1].y),
                   mass = 1 / (1 / sliding.state(slid[0])->mass + 1 / sliding.state(slid[1])->mass);
      run(turning, 1, dt), run(sliding, 0.4, dt);
      EXPECT_NEAR(turning.state(hinge)->speed, 20 / inertia, 0.01 * 20 / inertia);
      EXPECT_NEAR(sliding.state(slide)->speed, 0.4 * 30 / mass, 0.01 * 12 / mass);
      run(turning, 4, dt), run(sliding, 2, dt);
      EXPECT_NEAR(turning.state(hinge)->speed, 10, 0.01);
      EXPECT_NEAR(sliding.state(slide)->speed, 0.5, 0.005);
      EXPECT_NEAR(turning.angularMomentum().y, 0, 1e-6);
      EXPECT_NEAR(length(turning.linearMomentum() -
                         Vec3{0, gravity * 5, 0} * (turning.state(turned[0])->mass + turning.state(turned[1])->mass)),
                  0, 1e-6);
    }
}

}  // namespace
}  // namespace brickfall
