// A tonne at 0.2 m/s against a brick in mortar. Below the resting approach speed of 0.3 m/s nothing got a blow, so steps of 1/60 s stopped
// the tonne for nothing, and in steps of 1/960 s it crushed nothing and broke the brick out at 0.12 m/s.
#include "law/glued.h"

namespace brickfall {
namespace {

using namespace law;

bool breaksOut(double speed, double dt, double part) {
  constexpr double kRadius = 0.08, kMass = 1000;
  Glued g({.dt = dt}, emptySpace());
  g.brick({0, 1, 0});
  for (Vec3 off :
       {Vec3{kBrickSize.x, 0, 0}, Vec3{-kBrickSize.x, 0, 0}, Vec3{0, kBrickSize.y, 0}, Vec3{0, -kBrickSize.y, 0}})
    g.brick(Vec3{0, 1, 0} + off, BodyType::fixed);
  for (std::size_t j = 1; j < 5; j++) g.gluePair(0, j);
  BodyDef ball = bodyOf(sphereOf(kRadius, kMass / (4.0 / 3 * kPi * kRadius * kRadius * kRadius)),
                        {0, 1, 0.5 * kBrickSize.z + kRadius + part * speed * dt});
  ball.linearVelocity = {0, 0, -speed};
  add(g.world, ball);
  for (int i = 0; i < int(std::lround(0.2 / dt)); i++) g.step(dt);
  return g.broken == 4;
}

// By its joints' energy and what the blow crushes it comes out at 0.164 m/s.
TEST(Regression, SlowHeavyHitBreaksWhatItHasTheEnergyFor) {
  for (double dt : {1.0 / 60, 1.0 / 240, 1.0 / 960})
    for (double part : {0.3, 0.7, 0.95}) {
      EXPECT_TRUE(breaksOut(0.21, dt, part)) << dt << " s, " << part;
      EXPECT_FALSE(breaksOut(0.15, dt, part)) << dt << " s, " << part;
    }
}

}  // namespace
}  // namespace brickfall
