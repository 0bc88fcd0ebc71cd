// A ball whose last rebound was over within a step ended that 20 micrometres above the ground, by half of what the rebound
// would have carried it, and came down a step late: it was moved by the mean of its velocities, as what slides is.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, BallHangsWhereItBounced) {
  const double e = 0.3, bounces = std::sqrt(2 / kG) * (1 + e) / (1 - e);
  for (double rate : {30, 60}) {
    World world = awakeWorld();
    ShapeDef floor = planeOf(1), shape = sphereOf(0.25);
    floor.material.restitution = shape.material.restitution = e;
    add(world, bodyOf(floor, {}, BodyType::fixed));
    const BodyId ball = add(world, bodyOf(shape, {0, 1.25, 0}));
    double above = 0;
    while (world.time() < bounces + 2 / rate) {
      ASSERT_TRUE(world.step(1 / rate).ok());
      if (world.time() > bounces + 0.5 / rate) above = std::max(above, world.state(ball)->position.y - 0.25);
    }
    EXPECT_LE(above, 1e-6) << rate << " Hz";
  }
}

}  // namespace
}  // namespace brickfall
