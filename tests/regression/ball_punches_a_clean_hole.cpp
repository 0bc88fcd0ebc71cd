// A ball of 110 kg at 14.5 m/s goes a quarter of a metre in a step of 1/60 s. What it knocked out of a wall was gone before it could
// wedge anything aside: 15 bricks moved, where half of the wall does at 1/240 s and below. Scene: hole, ball.radius=0.15 speed=14.5.
// At 14.9 to 15.1 m/s the second of five equal parts ended where it hit, the third drove it half through: 13 to 75 bricks.
#include "law/motion.h"
#include "support/lab_scenes.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, HeavyBallMovesTheWallAtLongStepsToo) {
  struct Hit {
    double dt, speed;
  };
  for (const auto& [dt, speed] : {Hit{1.0 / 60, 14.5}, {1.0 / 60, 15}, {1.0 / 120, 14.5}}) {
    lab::Scene s = lab::make("hole10");
    const BodyId light = s.world.bodies().back();
    const double middle = s.world.state(light)->position.x;
    ASSERT_TRUE(s.world.destroyBody(light).ok());
    for (int k = 0; k < 0.3 / dt; k++) stepSound(s.world, dt);  // the wall comes to rest
    BodyDef ball = bodyOf(sphereOf(0.15, 7800), {middle, 1.3, 0.3});
    ball.linearVelocity = {0, 0, -speed};
    add(s.world, ball);
    int parts = 0, steps = 0;
    lab::Measured m = lab::run(s, 0.7, dt, [&](int, const StepReport& r) { parts += r.parts, steps++; });
    EXPECT_GT(parts, steps) << "1/" << 1 / dt << ", " << speed << " m/s";
    EXPECT_GT(m.moved50, 100) << "1/" << 1 / dt << ", " << speed << " m/s";
    expectSound(s.world);
  }
}

}  // namespace
}  // namespace brickfall
