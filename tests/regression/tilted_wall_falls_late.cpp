// A wall that is tilted slowly stood on past its balance: in each step what all of it lacked was little for each of its
// bricks. Clusters are judged by their weights at rest, too.
#include <cmath>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, TiltedWallFallsAtItsBalance) {
  const int courses = 20, across = 6;
  const double height = 0.065, balance = std::atan(0.12 / (courses * height));  // rad, of blocks 0.12 m thick
  World world = awakeWorld();
  addGround(world, 1);
  BodyId last;
  for (int c = 0; c < courses; c++)
    for (int i = 0; i < across; i++)
      last = addBox(world, {0.125, height / 2, 0.06}, {0.25 * i + 0.125 * (c % 2), height * (c + 0.5), 0});
  double tilt = balance - 0.05;
  auto lean = [&] { ASSERT_TRUE(world.setGravity(Vec3{0, -std::cos(tilt), std::sin(tilt)} * 9.81)); };
  lean();
  run(world, 1);
  while (tilt < balance + 0.02 && world.state(last)->position.z < 0.02) {
    tilt += 5e-5;
    lean();
    ASSERT_TRUE(world.step(1.0 / 60));
  }
  EXPECT_LT(tilt - balance, 0.0055) << "it falls late";
  EXPECT_GT(tilt - balance, -0.005) << "it falls early";
}

}  // namespace
}  // namespace brickfall
