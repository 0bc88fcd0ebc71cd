// A ball of 110 kg at 14.5 m/s goes a quarter of a metre in a step of 1/60 s. What it knocked out of a wall was gone before it could
// wedge anything aside: 15 bricks moved, where half of the wall does at 1/240 s and below. Scene: hole, ball.radius=0.15 speed=14.5.
// Not so at 14.85 to 15.1 m/s: there its middle ends a step within 3 mm of the wall's face, and 13 to 115 bricks move in most cases.
#include "law/motion.h"
#include "support/lab_scenes.h"

namespace brickfall {
namespace {

using namespace law;

TEST(Regression, HeavyBallMovesTheWallAtLongStepsToo) {
  for (double dt : {1.0 / 60, 1.0 / 120}) {
    lab::Scene s = lab::make("hole10");
    const BodyId light = s.world.bodies().back();
    const double middle = s.world.state(light)->position.x;
    ASSERT_TRUE(s.world.destroyBody(light).ok());
    for (int k = 0; k < 0.3 / dt; k++) stepSound(s.world, dt);  // the wall comes to rest
    BodyDef ball = bodyOf(sphereOf(0.15, 7800), {middle, 1.3, 0.3});
    ball.linearVelocity = {0, 0, -14.5};
    add(s.world, ball);
    int parts = 0, steps = 0;
    lab::Measured m = lab::run(s, 0.7, dt, [&](int, const StepReport& r) { parts += r.parts, steps++; });
    EXPECT_GT(parts, steps) << "1/" << 1 / dt;
    EXPECT_GT(m.moved50, 100) << "1/" << 1 / dt;
    expectSound(s.world);
  }
}

}  // namespace
}  // namespace brickfall
