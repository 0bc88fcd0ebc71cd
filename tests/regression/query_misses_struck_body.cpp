// The tree held the bounds foretold before the step: a body that a hit threw out of them was not found by queries, nor in
// a world restored at that moment.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, StruckBodyIsFoundWhereItIs) {
  World world = emptySpace();
  BodyDef ball = bodyOf(sphereOf(0.3, 8000), {-1, 0, 0});
  ball.linearVelocity = {90, 0, 0};
  add(world, ball);
  BodyId brick = addBox(world, {0.1, 0.1, 0.1}, {0, 0, 0});
  for (int i = 0; i < 3; i++) {
    stepSound(world);
    ASSERT_TRUE(world.restore(world.snapshot()).ok());
    expectSound(world);
    std::vector<BodyId> found = *world.overlapSphere(world.state(brick)->position, 0.01);
    ASSERT_EQ(found.size(), 1u) << "step " << i;
    EXPECT_EQ(found[0], brick);
  }
}

}  // namespace
}  // namespace brickfall
