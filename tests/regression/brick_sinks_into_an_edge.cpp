// A brick that lay across the edge of a floor, pressed in by a hit, sank through it while it rocked: 56 mm in `tower`, with its weight
// for all of its force. Its end crossed the edge in one point, so the contact was there alone, and the other end fell until it was the
// one point. Each overlap that so came about was kept as plastic.
#include <algorithm>

#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, BrickSinksIntoAnEdge) {
  lab::LabRandom random(1);
  auto between = [&](double from, double to) { return from + (to - from) * random.unit(); };
  double most = 0;
  int rocked = 0;
  for (int n = 0; n < 60; n++) {
    World world = awakeWorld();
    const BodyId floor = add(world, bodyOf(boxOf({0.6, 0.06, 0.6}), {0, -0.06, -0.6}, BodyType::fixed));
    BodyDef brick = bodyOf(boxOf({0.1075, 0.0325, 0.05125}, 1700), {0, 0, between(-0.02, 0.03)});
    // One draw a statement: compilers may draw operands in any order.
    const double roll = between(0.2, 0.8) * (n % 2 ? 1 : -1), yaw = between(-0.1, 0.1), tilt = between(-0.08, 0.08);
    brick.rotation = quatFromRotationVector({0, yaw, 0}) * quatFromRotationVector({0, 0, tilt}) *
                     quatFromRotationVector({roll, 0, 0});
    brick.angularVelocity = {0, 0, between(-3, 3)};
    const double pressedIn = between(0.01, 0.03);
    auto overlapOf = [&](BodyId body) { return *world.penetration(world.shapes(floor)[0], world.shapes(body)[0]); };
    double low = -0.05, high = 0.2;
    for (int halving = 0; halving < 30; halving++) {
      brick.position.y = 0.5 * (low + high);
      const BodyId trial = add(world, brick);
      (overlapOf(trial) > pressedIn ? low : high) = brick.position.y;
      ASSERT_TRUE(world.destroyBody(trial).ok());
    }
    const BodyId body = add(world, brick);
    const double start = overlapOf(body);
    ASSERT_NEAR(start, pressedIn, 1e-6);
    for (int step = 0; step < 40; step++) {
      ASSERT_TRUE(world.step(kDt).ok());
      most = std::max(most, overlapOf(body) - start);
      rocked += std::abs(world.state(body)->angularVelocity.z) > 0.5;
    }
  }
  EXPECT_GT(rocked, 60);
  EXPECT_LT(most, 2e-3) << "m deeper than it began";
}

}  // namespace
}  // namespace brickfall
