// Contacts saw only half a radian of the turn that a torque gives in a step, and bore no more of it: what was beyond
// acted on a brick as if nothing held it.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, TorqueThatTheWeightBearsTurnsNothing) {
  for (double dt : {1.0 / 30, 1.0 / 60}) {
    World world = awakeWorld();
    add(world, bodyOf(planeOf(), {}, BodyType::fixed));
    const Vec3 half{0.105, 0.0325, 0.05};
    const BodyId brick = add(world, bodyOf(boxOf(half, 2000), {-0.3, half.y, 0}));
    add(world, bodyOf(boxOf(half, 2000), {0.3, half.y, 0}));
    add(world, bodyOf(boxOf({0.5, 0.05, 0.2}, 5000), {0, 2 * half.y + 0.05, 0}));  // 200 kg
    for (int i = 0; i < 20; i++) EXPECT_TRUE(world.step(dt).ok());
    for (int i = 0; i < 30; i++) {
      EXPECT_TRUE(world.applyTorque(brick, {20, 0, 0}).ok());  // the weight bears 50 N m
      EXPECT_TRUE(world.step(dt).ok());
      EXPECT_LT(length(world.state(brick)->angularVelocity), 0.02) << dt;  // 7 rad/s before
    }
  }
}

}  // namespace
}  // namespace brickfall
