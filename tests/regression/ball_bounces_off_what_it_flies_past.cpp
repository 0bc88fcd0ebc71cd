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

}  // namespace
}  // namespace brickfall
