// After bodies fell asleep, or one was destroyed, the index of islands named islands that were gone: validate() complained
// and the snapshot of such a world was refused.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, SleepingWorldIsRestored) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0}), other = addBox(world, {0.2, 0.2, 0.2}, {3, 0.2, 0});
  run(world, 1.5);
  ASSERT_FALSE(world.state(box)->awake);
  expectSound(world);
  EXPECT_TRUE(world.restore(world.snapshot()).ok());
  ASSERT_TRUE(world.destroyBody(other).ok());
  expectSound(world);
  EXPECT_TRUE(world.restore(world.snapshot()).ok()) << "destroyed, not stepped yet";
}

}  // namespace
}  // namespace brickfall
