// A ball at 45 m/s through a wall of 12 x 12 at 1/30 s: one of the bricks that it had thrown out lay on nothing, but near enough to two
// that pressed on each other to be of their island. It was held at an obstacle; what that took of the island's angular momentum the
// two made good by a spin, whose energy was then taken from all three. The brick was accelerated by 12.6 g, by nothing.
#include "law/motion.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, UntouchedBrickIsThrown) {
  WallOf w;
  w.courses = w.bricks = 12;
  for (double aside : {0.027, 0.035, 0.045}) {
    BuiltWall wall = buildWall(w);
    shoot(wall, 0.08, 7800, {wall.middle + aside, 0.39 + aside * 4 / 9, 0.3}, {0, 0, -45});
    Untouched untouched;
    for (int i = 0; i < 15; i++) {
      stepSound(wall.world, 1.0 / 30);
      untouched.look(wall.world, wall.bricks);
    }
    EXPECT_GT(untouched.seen, 50) << "the hit must have thrown bricks";
    EXPECT_LT(untouched.thrown, 1e-9) << aside;
    EXPECT_LE(untouched.held, 1) << aside << ": an obstacle on its way";
  }
}

}  // namespace
}  // namespace brickfall
