// A rod that met a plate with an end deep in it and its middle close to the surface hung there: where the way of its middle
// was stopped its turn was stopped, too, step after step, though that could only take the end out.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, SpinningRodComesOutOfAPlate) {
  const double half = 0.035, radius = 0.0037;
  for (double spin : {200.0, 600.0}) {
    World world = emptySpace();
    BodyId plate = add(world, bodyOf(boxOf({half, 0.6, 0.6}), {}, BodyType::fixed));
    BodyDef d = bodyOf(capsuleOf(radius, 0.02, 2500), {half + 0.0009, 0, 0});
    d.rotation = turn({0, 0, 1}, 30);
    d.linearVelocity = {-3, 0, 0};
    d.angularVelocity = {0, 0, spin};
    BodyId rod = add(world, d);
    for (int i = 0; i < 20; i++) stepSound(world, 1.0 / 120);
    EXPECT_LT(world.penetration(world.shapes(rod)[0], world.shapes(plate)[0]).value(), 0.5 * radius) << spin;
    EXPECT_GT(world.state(rod)->position.x, half) << spin;
  }
}

}  // namespace
}  // namespace brickfall
