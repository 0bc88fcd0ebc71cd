// A step is made in parts where a heavy body goes far into a light one. Which bodies were asked for was read from the
// tree of the broad phase, whose bounds are larger where a body once was fast. A restored world, whose tree is new, then
// made its step in other parts, and went on differently.
#include "support/world_helpers.h"

namespace brickfall::test {
namespace {

TEST(RestoredWorldMakesOtherParts, HeavyBallPassesARodThatWasFast) {
  World world = emptySpace();
  const BodyId ball = add(world, bodyOf(sphereOf(0.1, 20000), {-5, 0.35, 0}));
  const BodyId rod = addBox(world, {0.02, 0.02, 0.5}, {0, 0, 0}, {0, 30, 0});
  stepSound(world);
  // It stops: its swept bounds are small, those in the tree are not.
  ASSERT_TRUE(world.setLinearVelocity(rod, {}).ok());
  const double height = world.state(rod)->position.y;
  stepSound(world);
  ASSERT_TRUE(world.setTransform(ball, {-0.1, height - 0.35, 0}, {}).ok());
  ASSERT_TRUE(world.setLinearVelocity(ball, {20, 0, 0}).ok());
  World restored = emptySpace();
  ASSERT_TRUE(restored.restore(world.snapshot()).ok());
  EXPECT_EQ(stepSound(restored).parts, stepSound(world).parts);
  EXPECT_EQ(restored.stateHash(), world.stateHash());
}

// What rested when the snapshot was taken counted as moving freely, so as turned to the axes of the world: bodies that went
// by were fitted in beside what was not there.
TEST(RestoredWorldMakesOtherParts, RodSpinsPastASlabThatRests) {
  World world = awakeWorld();
  addGround(world);
  BodyDef slab = bodyOf(boxOf({0.5, 0.05, 0.05}), {0, 0.05, 0});
  slab.rotation = turn({0, 1, 0}, 45);
  add(world, slab);
  run(world, 1);
  BodyDef rod = bodyOf(boxOf({0.1, 0.02, 0.02}), {0.3, 0.12, 0});
  rod.angularVelocity = {0, 40, 15};
  add(world, rod);
  for (int i = 0; i < 60; i++) {
    World restored = awakeWorld();
    ASSERT_TRUE(restored.restore(world.snapshot()).ok());
    stepSound(restored);
    stepSound(world);
    ASSERT_EQ(restored.stateHash(), world.stateHash()) << "step " << i;
  }
}

}  // namespace
}  // namespace brickfall::test
