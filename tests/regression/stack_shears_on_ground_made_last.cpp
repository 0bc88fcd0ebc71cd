// A stack that slid at 6 m/s came apart where its ground was made after it: points were matched by their place on the body made later,
// over which a slider's corners run, and those that had gone too far in a step lost their forces and anchors.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, StackShearsOnGroundMadeLast) {
  const double friction = 0.5, speed = 6, right = speed * speed / (2 * friction * kG);
  for (bool groundLast : {false, true})
    for (int count : {3, 6}) {
      World world = awakeWorld();
      const BodyDef ground = bodyOf(boxOf({20, 0.5, 5}, 1900, friction), {0, -0.5, 0}, BodyType::fixed);
      if (!groundLast) add(world, ground);
      std::vector<BodyId> bricks;
      for (int i = 0; i < count; i++) {
        BodyDef brick = bodyOf(boxOf({0.1075, 0.0325, 0.05125}, 1900, friction), {0, 0.0325 + 0.065 * i, 0});
        brick.linearVelocity = {speed, 0, 0};
        bricks.push_back(add(world, brick));
      }
      if (groundLast) add(world, ground);
      for (int k = 0; k < 120; k++) stepSound(world, 1.0 / 60);
      for (BodyId brick : bricks)
        EXPECT_NEAR(world.state(brick)->position.x, right, 0.005 * right) << count << " bricks " << groundLast;
      EXPECT_NEAR(world.state(bricks.back())->position.y, 0.065 * count - 0.0325, 1e-3);
    }
}

}  // namespace
}  // namespace brickfall
