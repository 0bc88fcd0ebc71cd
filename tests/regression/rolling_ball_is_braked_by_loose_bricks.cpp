// Balls that rolled over loose bricks laid flush lost 8 % of 2 m/s in 2 m at 1/60 s, and a third of 8 m/s, and were turned aside. The
// bricks are one island: the ball's contacts were as soft as debris, it sank in by up to 1.5 mm and ran against the next brick's edge;
// and edges that it touched from above were hit where the brick or the ball yielded by micrometres, or brought back what it passes.
#include "law/law.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, RollingBallIsBrakedByLooseBricks) {
  const Vec3 half = {0.1075, 0.0325, 0.05125};
  for (double dt : {1.0 / 60, 1.0 / 120})
    for (double density : {1900, 7850})
      for (double radius : {0.05, 0.1})
        for (double speed : {1, 2, 4, 8}) {
          World world = awakeWorld();
          addGround(world);
          for (int i = 0; i < 12; i++)
            for (int j = -2; j <= 2; j++)
              add(world, bodyOf(boxOf(half, 1900), {2 * half.x * i, half.y, 2 * half.z * j}));
          for (int i = 0; i < 10; i++) stepSound(world, dt);
          BodyDef ball = bodyOf(sphereOf(radius, density), {0.02, 2 * half.y + radius, 0.013});
          ball.linearVelocity = {speed, 0, 0};
          ball.angularVelocity = {0, 0, -speed / radius};
          const BodyId id = add(world, ball);
          while (world.state(id)->position.x < 2 && world.time() < 4) stepSound(world, dt);
          const BodyState end = *world.state(id);
          const std::string which =
              text(speed, 0) + " m/s, r " + text(radius, 2) + ", " + text(density, 0) + " kg/m3" + at(dt);
          EXPECT_NEAR(end.linearVelocity.x, speed, (dt > 0.01 ? 0.03 : 0.01) * speed) << which;
          EXPECT_NEAR(end.linearVelocity.z, 0, 0.002 * speed) << which;
        }
}

}  // namespace
}  // namespace brickfall
