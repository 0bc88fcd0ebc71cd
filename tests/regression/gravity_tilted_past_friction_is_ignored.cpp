// A block that had not strayed for half a second was stopped in its place, though gravity had been tilted past its friction
// meanwhile: the watch of its place ran on through the change.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// m, that a pile of so many blocks has slid after 5 s; gravity tilts within a second to `beyond` times what friction holds.
double slid(int blocks, double dt, double beyond) {
  const double friction = 0.5;
  World world = awakeWorld();
  addGround(world, friction);
  BodyId lowest;
  for (int i = 0; i < blocks; i++) {
    BodyId block = add(world, bodyOf(boxOf({0.2, 0.05, 0.2}, 1000, friction), {0, 0.05 + 0.1 * i, 0}));
    if (i == 0) lowest = block;
  }
  run(world, 0.6, dt);
  const double end = std::atan(beyond * friction);
  const int steps = int(std::lround(1 / dt));
  for (int i = 1; i <= steps; i++) {
    const double angle = end * i / steps;
    EXPECT_TRUE(world.setGravity({kG * std::sin(angle), -kG * std::cos(angle), 0}).ok());
    stepSound(world, dt);
  }
  run(world, 5, dt);
  return world.state(lowest)->position.x;
}

double expected(double beyond) {
  const double angle = std::atan(beyond * 0.5);
  return 0.5 * kG * (std::sin(angle) - 0.5 * std::cos(angle)) * 25;
}

TEST(Regression, WhatIsTiltedPastItsFrictionSlides) {
  for (int blocks : {1, 4}) {
    EXPECT_NEAR(slid(blocks, 1.0 / 60, 1.01), expected(1.01), 0.1 * expected(1.01)) << blocks << " blocks";
    EXPECT_NEAR(slid(blocks, 1.0 / 240, 1.02), expected(1.02), 0.1 * expected(1.02)) << blocks << " blocks";
  }
}

}  // namespace
}  // namespace brickfall
