// A ball of 110 kg at 15 m/s left a hole in some places of a wall at 1/60 s (90 to 119 of 196 bricks moved) where it pushes the wall
// apart at 1/480 s (129 to 149). Bricks that it wedges bear in one step many times what they bore before, and friction did not know it.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, HeavyBallSlipsThroughAWall) {
  constexpr int kCourses = 14, kShots = 3;
  const Vec3 half{0.1075, 0.0325, 0.05125};
  int moved = 0;
  for (int shot = 3; shot < 3 + kShots; shot++) {
    World world = awakeWorld();
    addGround(world);
    std::vector<BodyId> bricks;
    std::vector<Vec3> start;
    for (int c = 0; c < kCourses; c++)
      for (int i = 0; i < kCourses; i++) {
        start.push_back({2 * half.x * (i + 0.5 * (c % 2) - 0.5 * kCourses), half.y * (2 * c + 1), 0});
        bricks.push_back(add(world, bodyOf(boxOf(half, 1900), start.back())));
      }
    run(world, 0.3, kDt);
    BodyDef ball = bodyOf(sphereOf(0.15, 7800), {0.02 + 0.023 * shot, half.y * kCourses + 0.007 * shot, 0.3});
    ball.linearVelocity = {0, 0, -15};
    add(world, ball);
    run(world, 0.7, kDt);
    for (std::size_t i = 0; i < bricks.size(); i++) moved += length(world.state(bricks[i])->position - start[i]) > 0.05;
  }
  EXPECT_GE(moved, 115 * kShots);
}

}  // namespace
}  // namespace brickfall
