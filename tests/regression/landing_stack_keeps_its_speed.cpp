// A stack of ten slabs that landed on the move slipped between its slabs and kept up to 60 % of the speed that the ground's friction
// should have taken: the friction of points that had carried nothing was bounded by one slab's weight and approach.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, LandingStackKeepsItsSpeed) {
  const double friction = 0.3, along = 6, down = 6;
  for (int count : {3, 8, 10})
    for (double dt : {1.0 / 60, 1.0 / 120}) {
      World world = awakeWorld();
      add(world, bodyOf(boxOf({50, 0.5, 5}, 1000, friction), {0, -0.5, 0}, BodyType::fixed));
      std::vector<BodyId> slabs;
      for (int i = 0; i < count; i++) {
        BodyDef slab = bodyOf(boxOf({0.5, 0.05, 0.5}, 1900, 0.9), {0, 0.072 + 0.05 + 0.1 * i, 0});
        slab.shapes[0].material.frictionRule = CombineRule::minimum;
        slab.linearVelocity = {along, -down, 0};
        slabs.push_back(add(world, slab));
      }
      for (int k = 0; k < std::lround(0.162 / dt); k++) stepSound(world, dt);
      const double right = along - friction * (down + kG * world.time());
      for (BodyId slab : {slabs.front(), slabs.back()})
        EXPECT_NEAR(world.state(slab)->linearVelocity.x, right, 0.1 * (along - right))
            << count << " slabs, 1/" << 1 / dt;
    }
}

// A bed of blocks side by side lost up to half as much again: in the step after the impact its friction still had the impact's bound.
TEST(Regression, LandingBedIsBrakedTwice) {
  const double friction = 0.3, along = 6, down = 3;
  for (double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) {
    World world = awakeWorld();
    add(world, bodyOf(boxOf({50, 0.5, 50}, 1000, friction), {0, -0.5, 0}, BodyType::fixed));
    std::vector<BodyId> blocks;
    for (int i = 0; i < 81; i++) {
      BodyDef block = bodyOf(boxOf({0.2, 0.05, 0.2}, 1900, 0.9), {0.4 * (i % 9), 0.086, 0.4 * (i / 9)});
      block.shapes[0].material.frictionRule = CombineRule::minimum;
      block.linearVelocity = {along, -down, 0};
      blocks.push_back(add(world, block));
    }
    for (int k = 0; k < std::lround(0.12 / dt); k++) stepSound(world, dt);
    double mean = 0;
    for (BodyId block : blocks) mean += world.state(block)->linearVelocity.x / double(blocks.size());
    const double right = friction * (down + kG * world.time());
    EXPECT_NEAR(along - mean, right, 0.03 * right) << "1/" << 1 / dt;
  }
}

}  // namespace
}  // namespace brickfall
