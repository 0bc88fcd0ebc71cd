// Destroying any body threw all islands away, with the time they had rested: with debris removed in every step nothing
// ever fell asleep.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, DebrisRemovalKeepsAllAwake) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  for (int i = 0; i < 60; i++) {
    BodyId debris = addBox(world, {0.05, 0.05, 0.05}, {5, 0.05, 0});
    stepSound(world);
    ASSERT_TRUE(world.destroyBody(debris).ok());
  }
  EXPECT_FALSE(world.state(box)->awake);
}

}  // namespace
}  // namespace brickfall
