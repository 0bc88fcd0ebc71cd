// A slender block just past its balance rocked on the spot for seconds instead of falling.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, BlockJustPastItsBalanceFalls) {
  for (double dt : {1.0 / 60, 1.0 / 120}) {
    World world = awakeWorld();
    addGround(world, 2);
    BodyId block = add(world, bodyOf(boxOf({0.125, 0.5, 0.125}, 1000, 2), {0, 0.5, 0}));
    run(world, 0.5, dt);
    double angle = 14.3 * kPi / 180;  // balance at 14.036 degrees
    ASSERT_TRUE(world.setGravity({kG * std::sin(angle), -kG * std::cos(angle), 0}).ok());
    run(world, 2, dt);
    EXPECT_LT(toMatrix(world.state(block)->rotation).row[1].y, 0.9);
  }
}

}  // namespace
}  // namespace brickfall
