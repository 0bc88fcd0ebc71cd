// A plate that spins in its place on four feet lost up to 4 % of its friction, by chance: in some steps the
// rounding of its middle's speed was taken for a slide that ends, and half a step of friction was forgotten.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, PlateThatSpinsInPlaceIsBrakedByAllOfItsFriction) {
  const double friction = 0.3, arm = 0.4, spin = 6;
  for (int rate : {60, 120, 240, 1000}) {
    World world = makeWorld();
    addGround(world, friction);
    BodyDef def = bodyOf(boxOf({0.5, 0.02, 0.5}, 1000, friction), {0, 0.04, 0});
    for (int i = 0; i < 4; i++) {
      ShapeDef foot = sphereOf(0.02, 0.01, friction);
      foot.local.position = rotate(turn({0, 1, 0}, 90 * i), {arm, -0.02, 0});
      def.shapes.push_back(foot);
    }
    def.angularVelocity = {0, spin, 0};
    const BodyId plate = add(world, def);
    const MassProperties mass = *world.massProperties(plate);
    const double braking = friction * mass.mass * 9.81 * arm / mass.inertia.row[1].y;
    double turned = 0;
    for (int i = 0; i < rate; i++) {
      const Quat before = world.state(plate)->rotation;
      stepSound(world, 1.0 / rate);
      turned += rotationVector(world.state(plate)->rotation * conjugate(before)).y;
    }
    EXPECT_NEAR(turned, spin * spin / (2 * braking), 0.002 * turned) << "1/" << rate;
  }
}

}  // namespace
}  // namespace brickfall
