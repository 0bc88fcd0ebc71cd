// How fast a body is was judged by its spin at its inner radius: what is flat or long was stopped at visible speeds, a plank that rocks
// on a roller in its first level, and a body alone that rolls up a slope at 10 mm/s.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, ASlabThatSpinsOnSmoothGroundStopsDead) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    World world = awakeWorld();
    addGround(world, 0);
    BodyDef d = bodyOf(boxOf({0.5, 0.01, 0.5}), {0, 0.01, 0});
    d.angularVelocity = {0, 0.3, 0};
    BodyId slab = add(world, d);
    run(world, 2, dt);
    EXPECT_NEAR(world.state(slab)->angularVelocity.y, 0.3, 0.003);
  }
}

TEST(Regression, APlankThatRocksOnARollerStopsDead) {
  const double radius = 0.5, halfHeight = 0.01, tilt = 0.05;
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    World world = awakeWorld();
    ShapeDef roller = capsuleOf(radius, 1);
    roller.local.rotation = turn({1, 0, 0}, 90);
    roller.material.friction = 0.9;
    add(world, bodyOf(roller, {0, -radius, 0}, BodyType::fixed));
    BodyDef d = bodyOf(boxOf({1.2, halfHeight, 0.3}, 600, 0.9), {});
    d.rotation = quatFromAxisAngle({0, 0, 1}, tilt);
    d.position = Vec3{0, -radius, 0} + rotate(d.rotation, Vec3{radius * tilt, radius + halfHeight, 0});
    BodyId plank = add(world, d);
    double most = 0, least = 0;
    for (double time = 0; time < 6; time += dt) {
      stepSound(world, dt);
      double now = rotationVector(world.state(plank)->rotation).z;
      if (time > 3) most = std::max(most, now), least = std::min(least, now);
    }
    EXPECT_NEAR(most, tilt, 0.05 * tilt);
    EXPECT_NEAR(least, -tilt, 0.05 * tilt);
  }
}

TEST(Regression, ABallThatRollsUpASlopeTurnsBackAtOnce) {
  const double slope = 0.1 * kPi / 180, speed = 0.005, radius = 0.1;
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    WorldDef def;
    def.enableSleep = false;
    def.gravity = {-kG * std::sin(slope), -kG * std::cos(slope), 0};
    World world = makeWorld(def);
    addGround(world);
    BodyDef d = bodyOf(sphereOf(radius), {0, radius, 0});
    d.linearVelocity = {speed, 0, 0};
    d.angularVelocity = {0, 0, -speed / radius};
    BodyId ball = add(world, d);
    double most = 0;
    for (double time = 0; time < 1; time += dt) {
      stepSound(world, dt);
      most = std::max(most, world.state(ball)->position.x);
    }
    const double right = speed * speed * 1.4 / (2 * kG * std::sin(slope));
    EXPECT_NEAR(most, right, 0.02 * right);
  }
}

}  // namespace
}  // namespace brickfall
