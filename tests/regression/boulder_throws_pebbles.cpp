// A boulder that rolled over loose pebbles threw them at up to 3.7 km/s, and gained energy by it. Contacts were as firm as for
// a hundredth of its mass: they multiplied what floats round in the way of a pebble by millions.
#include <algorithm>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// A ball of `radius` (m) rolls at 3 m/s over pebbles of 3 to 5 mm. Returns the fastest speed of one. Energy never exceeds
// that of the start by more than a thousandth of what moves.
double fastestPebble(double radius, double dt, double between, double across) {
  World world = makeWorld({});
  Material stone;
  stone.density = 2600;
  stone.friction = 0.6;
  BodyDef ground = groundPlane();
  ground.shapes[0].material = stone;
  add(world, ground);
  std::vector<BodyId> pebbles;
  for (int i = 0; i < 40; i++)
    pebbles.push_back(add(world, ballBody(0.003 + 0.0005 * (i % 5), stone,
                                          {0.35 * radius + between * i, 0.004, across * ((i * 7) % 5 - 2)})));
  BodyDef boulder = ballBody(radius, stone, {0, radius, 0});
  boulder.linearVelocity = {3, 0, 0};
  boulder.angularVelocity = {0, 0, -3 / radius};
  const BodyId rolling = add(world, boulder);
  const double start = world.energy().kinetic + world.energy().potential;
  const double moves = world.energy().kinetic;
  double fastest = 0;
  for (int i = 0; i < int(0.5 / dt); i++) {
    world.step(dt).value();
    EXPECT_LT(world.energy().kinetic + world.energy().potential, start + 1e-3 * moves);
    for (BodyId pebble : pebbles) fastest = std::max(fastest, length(world.state(pebble)->linearVelocity));
  }
  EXPECT_GT(world.state(rolling)->linearVelocity.x, 2.5);
  return fastest;
}

TEST(Regression, ABoulderThrowsNoPebbles) {
  for (double dt : {1 / 30.0, 1 / 60.0}) {
    for (double radius : {0.5, 1.5}) {
      EXPECT_LT(fastestPebble(radius, dt, 0.012, 0.004), 12) << radius << " m at " << dt;
      EXPECT_LT(fastestPebble(radius, dt, 0.05, 0.02), 12) << radius << " m at " << dt << ", apart";
    }
  }
}

}  // namespace
}  // namespace brickfall
