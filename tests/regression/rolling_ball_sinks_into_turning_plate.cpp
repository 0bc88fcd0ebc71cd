// A light ball that rolled fast over a heavy turning plate was stopped there in every step and taken along by the plate's
// straight way but not by its turn: step by step it sank in, and came out on the far side.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

void rollOver(BodyType plateType) {
  const double radius = 0.0098, half = 0.0039, spin = 1.6, speed = 6, from = 0.42;
  World world = emptySpace();
  BodyDef plateDef = bodyOf(boxOf({0.44, 0.44, half}, 3400), {}, plateType);
  plateDef.angularVelocity = {0, spin, 0};  // where the ball is it goes away from the ball, beyond the axis to it
  BodyId plate = add(world, plateDef);
  BodyDef ballDef = bodyOf(sphereOf(radius, 4400), {from, 0.1, half + radius + 0.001});
  ballDef.linearVelocity = {-speed, 0, -spin * from};
  ballDef.angularVelocity = {0, -speed / radius, 0};
  BodyId ball = add(world, ballDef);
  for (int i = 0; i < 10; i++) {
    stepSound(world, 1.0 / 30);
    BodyState p = *world.state(plate);
    Vec3 at = transformPoint(inverse(Transform{p.position, p.rotation}), world.state(ball)->position);
    if (at.x > -0.44) {
      EXPECT_GT(at.z, half) << "step " << i;
    }
  }
}

TEST(Regression, BallStaysOnItsSideOfATurningPlate) { rollOver(BodyType::dynamic); }
TEST(Regression, BallStaysOnItsSideOfADrivenTurningPlate) { rollOver(BodyType::kinematic); }

}  // namespace
}  // namespace brickfall
