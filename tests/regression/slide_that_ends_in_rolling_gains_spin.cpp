// A capsule whose slide turned into rolling within its second step got half of that step's friction once more, as if it went on
// sliding: it left the step slipping backwards by a third of its speed, and rolled on 1.2 % too slow.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// From before one step to after several, by lengths of slides from half a step to three.
TEST(Regression, SlideThatEndsInRollingGainsSpin) {
  const double radius = 0.0104, mu = 0.99, dt = 1.0 / 120;
  for (double steps = 0.6; steps < 3; steps += 0.2) {
    World world = awakeWorld();
    add(world, bodyOf(planeOf(mu), {}, BodyType::fixed));
    ShapeDef shape;
    shape.type = ShapeType::capsule;
    shape.radius = radius;
    shape.halfHeight = 0.0195;
    shape.material = {.density = 2000, .friction = mu};
    BodyDef def = bodyOf(shape, {0, radius, 0});
    def.rotation = turn({1, 0, 0}, 90);
    const double k2 = 0.474;  // of the capsule about the axis that it rolls about: I / (m r2)
    const double speed = steps * dt * mu * kG * (1 + 1 / k2), rolling = speed / (1 + k2);
    def.linearVelocity = {speed, 0, 0};
    BodyId body = add(world, def);
    const MassProperties mass = *world.massProperties(body);
    ASSERT_NEAR(mass.inertia.row[1].y / (mass.mass * radius * radius), k2, 1e-3);
    for (int i = 0; i < 8; i++) {
      ASSERT_TRUE(world.step(dt).ok());
      const BodyState s = *world.state(body);
      EXPECT_GE(s.linearVelocity.x + s.angularVelocity.z * radius, -0.01 * rolling) << steps << " steps, step " << i;
    }
    EXPECT_NEAR(world.state(body)->linearVelocity.x, rolling, 2e-3 * rolling) << "slides for " << steps << " steps";
  }
}

}  // namespace
}  // namespace brickfall
