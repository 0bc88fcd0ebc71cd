// A ball that flew past an edge bounced off it: the point that was nearest when the step began, with its normal, stood in its way like a
// wall.
#include "law/motion.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, BallBouncesOffWhatItFliesPast) {
  for (double dt : kMotionSteps)
    for (double speed : {5.0, 20.0, 40.0})
      for (double clearance : {0.002, 0.012}) {
        WallOf w;
        w.bricks = 6;
        BuiltWall wall = buildWall(w);
        run(wall.world, 0.3, dt);
        BodyDef ball = bodyOf(sphereOf(0.1, 7800), {wall.middle + 0.03, 0.75 + clearance, 1.013});
        ball.linearVelocity = {0, 0, -speed};
        ball.gravityScale = 0;
        BodyId body = add(wall.world, ball);
        run(wall.world, 2 / speed, dt);
        BodyState after = *wall.world.state(body);
        EXPECT_LT(after.position.z, -0.9) << "it must have come past";
        EXPECT_NEAR(length(after.linearVelocity - ball.linearVelocity), 0, 1e-4)
            << speed << " m/s, " << clearance << " m above, " << 1 / dt;
      }
}

// What flies straight on passes under the wall; but the floor turns it into the wall.
TEST(Regression, BallGoesIntoTheWallBehindTheFloor) {
  for (bool plane : {true, false})
    for (double before : {0.02, 0.06, 0.1, 0.15, 0.25}) {  // m, the floor is hit so far before the wall
      World world = awakeWorld();
      if (plane)
        addGround(world, 0);
      else
        add(world, bodyOf(boxOf({5, 0.5, 5}, 1000, 0), {0, -0.5, 0}, BodyType::fixed));
      add(world, bodyOf(boxOf({0.1, 0.5, 1}, 1000, 0), {0.1, 0.5, 0}, BodyType::fixed));
      BodyDef ball = bodyOf(sphereOf(0.05, 7800, 0), {-0.05 - before - 0.15, 0.2, 0});
      ball.linearVelocity = {14, -14, 0};
      BodyId body = add(world, ball);
      double deepest = 0;
      for (int k = 0; k < 20; k++) {
        stepSound(world, kDt);
        deepest = std::max(deepest, world.state(body)->position.x + 0.05);
      }
      EXPECT_LT(deepest, 0.01) << "plane " << plane << ", " << before;
    }
}

}  // namespace
}  // namespace brickfall
