// A body that slid slowly past something a few millimetres beside it was stopped early: the energy that its friction
// took was that of a trial of how it would go on, not that of its last step, so that the end of its slide looked like
// that of a swing.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

double wayOfSlider(double speed, double friction, bool besideWall) {
  World world = awakeWorld();
  addGround(world, friction);
  if (besideWall) add(world, bodyOf(boxOf({1, 0.1, 0.1}), {0, 0.1, 0.152}, BodyType::fixed));
  BodyDef slider = bodyOf(boxOf({0.1, 0.05, 0.05}, 1000, friction), {0, 0.05, 0});
  slider.linearVelocity = {speed, 0, 0};
  BodyId body = add(world, slider);
  run(world, 0.5);
  return world.state(body)->position.x;
}

TEST(Regression, SlowSliderStopsBesideAWall) {
  const double friction = 0.002, lostInAStep = friction * 9.81 * kDt;  // m/s
  for (double steps : {2.3, 2.7}) {
    const double alone = wayOfSlider(steps * lostInAStep, friction, false);
    ASSERT_GT(alone, 0);
    EXPECT_NEAR(wayOfSlider(steps * lostInAStep, friction, true), alone, 0.02 * alone) << steps;
  }
}

}  // namespace
}  // namespace brickfall
