// Kinetic damping read of the last step whether what carries an island moves: in the step in which a plate began to move, a slow
// body on it that lost energy was stopped dead. Now no ground stops what its friction could not: smooth ground, moving or not, nothing.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, GroundThatBeginsToMoveDoesNotStopWhatSlides) {
  for (bool starts : {false, true}) {
    World world = awakeWorld();
    BodyId plate = add(world, bodyOf(boxOf({1, 0.1, 1}, 1000, 0), {0, -0.1, 0}, BodyType::kinematic));
    BodyDef slider = bodyOf(boxOf({0.1, 0.05, 0.1}, 1000, 0), {0, 0.05, 0});
    slider.linearVelocity = {0.009, 0, 0};
    slider.linearDamping = 1;  // loses energy in every step
    BodyId body = add(world, slider);
    stepSound(world);
    EXPECT_NEAR(world.state(body)->linearVelocity.x, 0.009, 2e-4);
    if (starts) {
      ASSERT_TRUE(world.setLinearVelocity(plate, {0, 0, 0.001}).ok());
    }
    stepSound(world);
    EXPECT_NEAR(world.state(body)->linearVelocity.x, 0.0087, 1e-4);
  }
}

}  // namespace
}  // namespace brickfall
