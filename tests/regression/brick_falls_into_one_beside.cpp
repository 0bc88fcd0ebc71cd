// Bricks that came together across their edges had no points: where the step began, no face of the one lay over one of
// the other. They ended the step in each other, here up to 45 mm deep, and 34 in the debris of a house.
#include <algorithm>

#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, BrickFallsIntoOneBeside) {
  const Vec3 half{0.1075, 0.0325, 0.05125};
  double deepest = 0;
  for (double across : {0.5, 1.0, 2.0, 4.0})
    for (double degrees : {0.0, 5.0, 20.0}) {
      World world = emptySpace();
      const BodyId lower = addBox(world, half, {});
      BodyDef falling = bodyOf(boxOf(half), {2 * half.x + 0.003, 2 * half.y + 0.03, 0});
      falling.linearVelocity = {-across, -4.5, 0};
      falling.rotation = turn({0, 1, 0}, degrees);
      falling.position.x += half.x * std::fabs(std::sin(degrees * kPi / 180)) / 3;
      const BodyId upper = add(world, falling);
      stepSound(world);
      deepest = std::max(deepest, *world.penetration(world.shapes(lower)[0], world.shapes(upper)[0]));
    }
  EXPECT_LT(deepest, 2e-3);
}

}  // namespace
}  // namespace brickfall
