// A row of boxes on smooth ground that one of them pushes slowly lost its momentum: the energy that joints gave back was taken from all that
// stands, and what slides by less than a millimetre a second counted as at rest.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, RowOnIceStops) {
  struct Case {
    int boxes;
    double speed;  // m/s, of the first
  };
  for (Case c : {Case{6, 0.02}, {12, 0.05}, {26, 0.005}, {40, 0.005}, {90, 0.05}, {90, 0.2}})
    for (double dt : {1.0 / 60, 1.0 / 120}) {
      World world = awakeWorld();
      addGround(world, 0);
      for (int i = 0; i < c.boxes; i++)
        addBox(world, {.05, .05, .05}, {i * .1 + (i ? .0005 : 0), .05, 0}, {i ? 0 : c.speed, 0, 0});
      const double given = world.linearMomentum().x;
      run(world, 2, dt);
      EXPECT_NEAR(world.linearMomentum().x / given, 1, 0.005) << c.boxes << " boxes, " << c.speed << " m/s";
    }
}

}  // namespace
}  // namespace brickfall
