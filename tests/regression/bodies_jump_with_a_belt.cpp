// Two balls that fly beside a driven plate, as fast as it, met each other late in a step. The plate was taken to start from where
// it was when the step began: they seemed to have met it, and were stopped, or taken through to its other side.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, BodiesJumpWithABelt) {
  constexpr double kStep = 1.0 / 360, kMeet = .95;              // s; of the step
  constexpr double kAway = .022, kRadius = .01, kCloses = 1.5;  // m, m, m/s
  const Vec3 drive{4, -10, 3};
  World world = emptySpace();
  BodyDef plate = bodyOf(boxOf({1, .001, 1}), {0, -.001, 0}, BodyType::kinematic);
  plate.linearVelocity = drive;
  const BodyId belt = add(world, plate);
  BodyId balls[2];
  for (int side : {-1, 1}) {
    BodyDef ball = bodyOf(sphereOf(kRadius, 1000), {side * (kRadius + kCloses * kMeet * kStep), kAway, 0});
    ball.linearVelocity = drive + Vec3{-side * kCloses, 0, 0};
    balls[side > 0] = add(world, ball);
  }
  stepSound(world, kStep);
  for (BodyId ball : balls)
    EXPECT_NEAR(world.state(ball)->position.y - world.state(belt)->position.y, kAway + .001, 1e-6);
}

}  // namespace
}  // namespace brickfall
