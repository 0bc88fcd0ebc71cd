// A long row of boxes that hangs by joints was pushed a little, and each step took all of its direct steps and cycles. Its joints are firm
// for all that hangs there: the last bits of how far a box turns were forces beyond what counts as balance, and were followed.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

int mostCycles(int boxes) {
  World world = makeWorld();
  BodyId last = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {}, BodyType::fixed));
  std::vector<BodyId> row;
  for (int i = 0; i < boxes; i++) {
    const double y = -0.55 * (i + 1);
    row.push_back(addBox(world, {0.25, 0.25, 0.25}, {0, y, 0}));
    JointDef def;
    def.anchor = {0, y + 0.275, 0};
    def.bodyA = last;
    def.bodyB = last = row.back();
    EXPECT_TRUE(world.createJoint(def).ok());
  }
  int most = 0;
  for (int i = 0; i < 12; i++) {
    for (std::size_t k = 0; k < row.size() && i % 10 == 0; k++) {
      const int x = int(k * 7) % 5 - 2, z = int(k * 3) % 7 - 3;
      EXPECT_TRUE(world.setLinearVelocity(row[k], {0.02 * x, 0, 0.02 * z}).ok());
    }
    most = std::max(most, int(world.step(1.0 / 60)->cycles));
  }
  return most;
}

TEST(Regression, LongRowOfJointsIsNeverSolved) {
  EXPECT_LE(mostCycles(100), 25);
  EXPECT_LE(mostCycles(500), 5);
}

}  // namespace
}  // namespace brickfall
