// The spin of every body in contact was cut to 0.5 rad a step: a ball that rolled faster was braked by its own friction.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, FastRollingBallKeepsItsSpeed) {
  World world = awakeWorld();
  addGround(world);
  BodyDef d = bodyOf(sphereOf(0.05), {0, 0.05, 0});
  d.linearVelocity = {8, 0, 0};
  d.angularVelocity = {0, 0, -160};
  BodyId ball = add(world, d);
  run(world, 1);
  EXPECT_NEAR(world.state(ball)->linearVelocity.x, 8, 0.05);
  EXPECT_NEAR(world.state(ball)->angularVelocity.z, -160, 1);
}

}  // namespace
}  // namespace brickfall
