// A ball of 16.7 kg at 40 m/s into a wall in cement, in steps of 1/60 s. Where it arrived late in a step, most of the step's parts had
// been made while it flew, and the hit came in a long one: the ball kept 21.6 of its 40 m/s, in steps of 1/480 s 18.2.
#include "law/draw.h"

namespace brickfall {
namespace {

using namespace law;

// m/s, behind the wall; `late`: share of a step that the ball flies before the one that it begins with.
double speedBehind(double late, double dt) {
  constexpr double kSpeed = 40, kRadius = 0.08;
  constexpr int kCourses = 10, kBricks = 8;
  const Vec3 half{0.1075, 0.0325, 0.05125};
  World world = makeWorld({});
  BodyDef ground = bodyOf(boxOf({5, 0.5, 5}, 1900), {0.86, -0.5, 0});
  ground.type = BodyType::fixed;
  add(world, ground);
  for (int row = 0; row < kCourses; row++)
    for (int k = 0; k < kBricks; k++)
      add(world, bodyOf(boxOf(half, 1900), {(2 * k + row % 2) * half.x, (2 * row + 1) * half.y, 0}));
  const std::vector<BodyId> bricks = world.bodies();
  for (std::size_t i = 1; i < bricks.size(); i++)
    for (std::size_t k = i + 1; k < bricks.size() && k - i <= kBricks + 1; k++) {
      MortarDef mortar;
      mortar.bodyA = bricks[i];
      mortar.bodyB = bricks[k];
      mortar.outline = *world.sharedFace(bricks[i], bricks[k]);
      if (!mortar.outline.empty()) (void)world.createMortar(mortar).value();
    }
  for (int i = 0; i < 6; i++) (void)world.step(dt).value();
  BodyDef ball = bodyOf(sphereOf(kRadius, 7800), {0.91, kCourses * half.y, 0.15 + kSpeed * dt * late});
  ball.linearVelocity = {0, 0, -kSpeed};
  const BodyId id = add(world, ball);
  for (int i = 0; i < int(0.05 / dt); i++) (void)world.step(dt).value();
  return -world.state(id)->linearVelocity.z;
}

TEST(Regression, LateHitInAStepBreaksLess) {
  double behind = 0, fine = 0;  // m/s, means; the same three places of the ball
  for (double late : {0.73, 0.78, 0.83}) {
    behind += speedBehind(late, 1.0 / 60) / 3;
    fine += speedBehind(8 * late, 1.0 / 480) / 3;
  }
  EXPECT_LT(behind, fine + 1.5) << fine << " m/s in steps of 1/480 s";
}

}  // namespace
}  // namespace brickfall
