// A ball that rebounds within a step goes on along another way than the one along which its contacts were looked for: it ended the
// step in a ledge above the ground, a fourth of its radius deep.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, ReboundEndsInWhatLiesAside) {
  constexpr double kRadius = .05, kSpeed = 3, kStep = 1.0 / 30;  // m, m/s, s
  World world = emptySpace();
  BodyDef ground = bodyOf(boxOf({1, .5, 1}, 1000, 0), {0, -.5, 0}, BodyType::fixed);
  ground.shapes[0].material.restitution = 1;
  add(world, ground);
  const BodyId ledge = add(world, bodyOf(boxOf({.2, .2, .2}, 1000, 0), {.32, .33, 0}, BodyType::fixed));
  BodyDef flying = bodyOf(sphereOf(kRadius, 1000, 0), {0, kRadius + kSpeed * kStep / 2, 0});
  flying.shapes[0].material.restitution = 1;
  flying.linearVelocity = {kSpeed, -kSpeed, 0};
  const BodyId ball = add(world, flying);
  stepSound(world, kStep);
  const Result<double> depth = world.penetration(world.shapes(ball)[0], world.shapes(ledge)[0]);
  ASSERT_TRUE(depth.ok());
  EXPECT_LT(*depth, .02 * kRadius);
}

}  // namespace
}  // namespace brickfall
