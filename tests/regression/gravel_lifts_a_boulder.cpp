// A boulder presses gravel into the ground until it overlaps by half its height. Each step a tenth of that was let go,
// against springs as firm as for a hundredth of the boulder's mass: they held up to a hundred times the energy of all
// that moves, which nobody had given to them, and a boulder gained up to a third of its own in one step.
#include <algorithm>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Boulder {
  double radius, gravel, friction, restitution, dt, time;  // m, m, 1, 1, s, s
};

double energyOf(const World& world) { return world.energy().kinetic + world.energy().potential; }

// The most that fifty boxes of gravel, and a boulder that rolls over them at 3 m/s, gain in a step, of what moves.
double mostGained(const Boulder& b) {
  World world = makeWorld({});
  Material stone;
  stone.density = 2600;
  stone.friction = b.friction;
  stone.restitution = b.restitution;
  BodyDef ground = groundPlane();
  ground.shapes[0].material = stone;
  add(world, ground);
  for (int i = 0; i < 50; i++) {
    const double size = b.gravel * (1 + 0.15 * (i % 5));
    const Vec3 at = {0.35 * b.radius + (i / 5) * 3.2 * b.gravel, 0.7 * size, ((i * 7) % 5 - 2) * 2.6 * b.gravel};
    add(world, boxBody(Vec3{2, 1.4, 1.6} * size, stone, at));
  }
  BodyDef boulder = ballBody(b.radius, stone, {0, b.radius, 0});
  boulder.linearVelocity = {3, 0, 0};
  boulder.angularVelocity = {0, 0, -3 / b.radius};
  add(world, boulder);
  const double moves = world.energy().kinetic;
  double most = 0, before = energyOf(world);
  for (int i = 0; i < int(b.time / b.dt); i++) {
    world.step(b.dt).value();
    const double now = energyOf(world);
    most = std::max(most, now - before);
    before = now;
  }
  return most / moves;
}

TEST(Regression, GravelLiftsABoulder) {
  for (const Boulder& b : {Boulder{1.5, 0.01, 1, 0.3, 1e-3, 0.4},
                           {5, 0.02, 0.3, 0, 1 / 240.0, 1},
                           {1.5, 0.01, 1, 0, 1 / 240.0, 1},
                           {1.5, 0.02, 1, 0, 1 / 60.0, 1}})
    EXPECT_LT(mostGained(b), 1e-3) << b.radius << " m over " << b.gravel << " m at " << b.dt << " s";
}

}  // namespace
}  // namespace brickfall
