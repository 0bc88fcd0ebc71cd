// A cone on its side that rolled round its tip sank into the ground, by up to a fortieth of its radius at 1/60 s, and lost
// 12 % of its energy in half a round: the two ends of its line of touch go different ways in a step, and had the
// same; and its turn was made in two, of which one tilted it.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, RollingConeSinksIn) {
  const double radius = 0.1, opening = 1.0 / 3, angle = std::atan(opening), length = radius / opening;
  for (double rate : {60, 120, 240})
    for (double share : {0.125, 0.25, 0.5}) {  // of a radian in the time of a fall by half of the radius
      World world = awakeWorld();
      BodyId ground = add(world, bodyOf(planeOf(1), {}, BodyType::fixed));
      ShapeDef shape = coneOf(radius, 0, 0.5 * length);
      shape.material.friction = 1;
      BodyDef def = bodyOf(shape, Vec3{std::cos(angle), std::sin(angle), 0} * (0.5 * length));
      def.rotation = quatFromAxisAngle({0, 0, 1}, kPi / 2 + angle);
      def.angularVelocity = {-share * std::sqrt(kG / radius) / opening, 0, 0};
      def.linearVelocity = cross(def.angularVelocity, Vec3{std::cos(angle), std::sin(angle), 0} * (0.75 * length));
      BodyId cone = add(world, def);
      const double start = world.energy().kinetic;
      double deepest = 0;
      for (int i = 0; i < int(1.2 * rate); i++) {
        ASSERT_TRUE(world.step(1 / rate).ok());
        deepest = std::max(deepest, *world.penetration(world.shapes(cone)[0], world.shapes(ground)[0]));
      }
      EXPECT_LE(deepest, 2e-3 * radius) << rate << " Hz, " << share;
      EXPECT_NEAR(world.energy().kinetic / start, 1, 5e-3) << rate << " Hz, " << share;
    }
}

}  // namespace
}  // namespace brickfall
