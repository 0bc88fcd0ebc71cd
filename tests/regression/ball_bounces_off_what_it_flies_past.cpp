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
        EXPECT_NEAR(length(after.linearVelocity - ball.linearVelocity), 0, 1e-3)
            << speed << " m/s, " << clearance << " m above, " << 1 / dt;
      }
}

// Straight on it would pass below the lintel, in the ground; but the ground turns it into the lintel. (Passed over, it went through.)
TEST(Regression, BallGoesIntoTheLintelAboveTheGround) {
  constexpr double kRadius = 0.1, kAbove = 0.15;             // m: of the ball; it starts so far above the ground
  for (double gap : {0.12, 0.15, 0.18})                      // m, below the lintel
    for (double speed : {14.0, 30.0})                        // m/s, level and down
      for (double before : {0.02, 0.06, 0.15, 0.25, 0.3}) {  // m, the ground is hit so far before the lintel
        World world = awakeWorld();
        addGround(world, 0);
        add(world, bodyOf(boxOf({0.1, 0.2, 1}, 1000, 0), {0.1, gap + 0.2, 0}, BodyType::fixed));
        BodyDef ball = bodyOf(sphereOf(kRadius, 7800, 0), {-kRadius - before - kAbove, kRadius + kAbove, 0});
        ball.linearVelocity = {speed, -speed, 0};
        BodyId body = add(world, ball);
        double least = kRadius;  // m, of its middle from the lintel's lower edge
        for (int k = 0; k < 20; k++) {
          stepSound(world, kDt);
          const Vec3 at = world.state(body)->position;
          least = std::min(least, length(Vec3{std::max(0.0, -at.x), std::max(0.0, gap - at.y), 0}));
        }
        EXPECT_GT(least, kRadius - 0.002) << gap << " m, " << speed << " m/s, " << before;
        EXPECT_LT(world.state(body)->position.x, 0) << gap << " m, " << speed << " m/s, " << before;
      }
}

}  // namespace
}  // namespace brickfall
