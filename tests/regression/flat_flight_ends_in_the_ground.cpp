// A brick that flew low and fast, turned into the ground and was left there: what flies pays for being shifted against
// its weight, and it paid by its speed along the weight alone. What flew level had none. (Left up to 32 mm deep.)
#include <algorithm>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// A ball of 4 t goes into a low wall. How deep a brick ends in the ground, m.
double deepestInTheGround(int shot, double dt) {
  constexpr int kCourses = 6, kBricks = 12;
  const Vec3 half{0.1075, 0.0325, 0.05125};
  World world = awakeWorld();
  const ShapeId ground = world.shapes(addGround(world)).front();
  for (int c = 0; c < kCourses; c++)
    for (int i = 0; i < kBricks; i++)
      add(world, bodyOf(boxOf(half, 1900), {2 * half.x * (i + 0.5 * (c % 2)), half.y * (2 * c + 1), 0}));
  BodyDef ball = bodyOf(sphereOf(0.5, 7800), {half.x * kBricks + 0.037 * shot, 0.6, 0.7});
  ball.linearVelocity = {0, 0, -20};
  add(world, ball);
  double out = 0;
  for (int k = 0; k < int(0.15 / dt); k++) {
    stepSound(world, dt);
    world.forEachContact([&](const ContactView& c) {
      if (c.shapeA == ground || c.shapeB == ground) out = std::max(out, *world.penetration(c.shapeA, c.shapeB));
    });
  }
  return out;
}

TEST(Regression, FlatFlightEndsInTheGround) {
  for (const auto& [shot, dt] : {std::pair{2, 1.0 / 60}, {3, 1.0 / 60}, {7, 1.0 / 60}, {6, 1.0 / 120}})
    EXPECT_LT(deepestInTheGround(shot, dt), 0.01) << "shot " << shot << ", 1/" << 1 / dt << " s";
}

}  // namespace
}  // namespace brickfall
