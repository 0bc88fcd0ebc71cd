// A box that met a thin plate with a corner was spun through most of a turn within the step, with arms frozen, and came
// out on the far side.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, SpunBoxStaysOnItsSideOfAPlate) {
  World world = emptySpace();
  add(world, bodyOf(boxOf({2, 2, 0.01}), {}, BodyType::fixed));
  BodyDef d = bodyOf(boxOf({0.146, 0.190, 0.066}), {-0.4071, -0.3261, 1.8570});
  d.rotation = {0.3, -0.4, 0.1, 1};
  d.linearVelocity = {41.08, -30.438, -169.268};
  d.angularVelocity = {9.44, 1.34, -8.75};
  BodyId box = add(world, d);
  for (int i = 0; i < 30; i++) {
    stepSound(world);
    Vec3 at = world.state(box)->position;
    ASSERT_TRUE(at.z > 0 || std::fabs(at.x) > 1.9 || std::fabs(at.y) > 1.9) << "step " << i;
  }
}

}  // namespace
}  // namespace brickfall
