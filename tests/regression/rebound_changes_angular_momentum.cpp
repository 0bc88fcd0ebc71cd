// Off-centre rebounds of free bodies changed the angular momentum by some per cent: displacements and velocities of the
// rebound are found apart.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, ReboundKeepsAngularMomentum) {
  World world = emptySpace();
  ShapeDef shape = boxOf({0.1, 0.2, 0.15});
  shape.material.restitution = 0.8;
  BodyDef d = bodyOf(shape, {-1, 0.15, 0.1});
  d.linearVelocity = {4, 0, 0};
  d.angularVelocity = {1, 2, 3};
  add(world, d);
  add(world, bodyOf(shape, {}));
  Vec3 before = world.angularMomentum();
  double energy = world.energy().kinetic;
  for (int i = 0; i < 60; i++) {
    stepSound(world);
    EXPECT_LT(length(world.angularMomentum() - before), 1e-5 * length(before)) << "step " << i;
    EXPECT_LE(world.energy().kinetic, energy * (1 + 1e-3));
  }
  EXPECT_GT(length(world.state(world.bodies()[1])->linearVelocity), 0.5) << "they met";
}

}  // namespace
}  // namespace brickfall
