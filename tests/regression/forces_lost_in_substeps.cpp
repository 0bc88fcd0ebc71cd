// Forces were forgotten after the first substep: with four of them a quarter of the impulse arrived.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, ForcesLastForAllSubsteps) {
  for (int substeps : {1, 4, 64}) {
    World world = emptySpace();
    BodyId body = addBox(world, {0.1, 0.1, 0.1}, {});  // 8 kg
    ASSERT_TRUE(world.applyForce(body, {480, 0, 0}).ok());
    stepSound(world, kDt, substeps);
    EXPECT_NEAR(world.state(body)->linearVelocity.x, 1, 1e-12) << substeps;
    stepSound(world, kDt, substeps);
    EXPECT_NEAR(world.state(body)->linearVelocity.x, 1, 1e-12) << "and not longer";
  }
}

}  // namespace
}  // namespace brickfall
