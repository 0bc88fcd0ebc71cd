// Two boxes on a slide that a bounce threw up fell by half of gravity as long as its limit held them: each step the last check
// let them go as one body, by free motions that lacked what a swing takes back before it begins. They rose twice as high.
#include <algorithm>
#include <cmath>

#include "law/random_linkage.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, ThrownUpLinkageFallsByHalf) {
  law::RandomLinkage linkage = law::drawLinkage(law::LinkageKind::falls, 2850);
  World& world = linkage.world;
  auto energy = [&] { return world.energy().kinetic + world.energy().potential; };
  double last = energy(), rise = 0, moved = 0, highest = -1e300, lowest = 1e300;
  for (int i = 0; i < linkage.steps; i++) {
    ASSERT_TRUE(world.step(linkage.dt, linkage.substeps).ok());
    const double now = energy();
    rise = std::max(rise, now - last);
    moved = std::max(moved, world.energy().kinetic);
    last = now;
    const double height = world.state(linkage.bodies[0])->centreOfMass.y;
    lowest = std::min(lowest, height);
    if (height > lowest + 1e-3) highest = std::max(highest, height);
  }
  EXPECT_GT(highest, lowest + 0.5) << "it was not thrown up";
  EXPECT_LT(rise, 1e-5 * moved);
}

}  // namespace
}  // namespace brickfall
