// A ball of 4 t hit a wall at 20 m/s and hung among its bricks for 20 steps, in mid-air, keeping its speed: each step the
// bricks pressed into it stopped its way anew. What is far lighter stops nothing.
#include <gtest/gtest.h>

#include "support/lab_scenes.h"

namespace brickfall {
namespace {

TEST(Regression, HeavyBallHangsInTheWall) {
  lab::Scene s = lab::make("wall_hit", {});
  BodyId ball = s.world.bodies().back();
  double speed = 20;
  for (int i = 0; i < 40; i++) {
    Vec3 before = s.world.state(ball)->position;
    ASSERT_TRUE(s.world.step(1.0 / 60).ok());
    BodyState now = *s.world.state(ball);
    EXPECT_LT(now.position.z - before.z, -0.5 * speed / 60) << "step " << i;
    speed = length(now.linearVelocity);
  }
  EXPECT_GT(speed, 8);
}

}  // namespace
}  // namespace brickfall
