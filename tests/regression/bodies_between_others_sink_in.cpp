// What ended aside was fitted in as if its neighbours could not move, nor what flew or was stopped on its way without a
// contact: it stayed in one or the other, or came out at the far side of what is thin. Worlds drawn at random: two that
// meet in space (left 57 mm deep in each other); a plate between a body and the ground, a ball that another one presses
// into a belt, two that arrive at a belt or at hills at once, one whose end is in hills where its core was stopped (all
// went through).
#include "law/random_world.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace brickfall::law {

TEST(Regression, BodiesBetweenOthersSinkIn) {
  for (const auto& [kind, seed] : {std::pair{RandomKind::space, 10527},
                                   {RandomKind::ground, 11093},
                                   {RandomKind::belt, 4165},
                                   {RandomKind::belt, 14620},
                                   {RandomKind::terrain, 15859},
                                   {RandomKind::terrain, 111},
                                   {RandomKind::plate, 32358},
                                   {RandomKind::wall, 33906},
                                   {RandomKind::wall, 30171}})
    expectNothingFromNothing(kind, seed);
}

// A body of 1.4 g was pressed 7 mm into a belt by one of 239 g, and then through it: it went less than its radius in a step, so nobody
// looked whether its core met the belt.
TEST(Regression, PressedInBodyIsPushedThroughABelt) {
  for (int substeps = 1; substeps <= 6; substeps++) {
    RandomWorld random = drawWorld(RandomKind::belt, 14620);
    double lowest = 1;  // m, of its middle above that of the belt
    for (int i = 0; i < random.steps; i++) {
      ASSERT_TRUE(random.world.step(random.dt, i == 9 ? substeps : 1).ok());
      const BodyState belt = *random.world.state(*random.target);
      const Vec3 at = random.world.state(random.bodies[0])->centreOfMass - belt.position;
      lowest = std::min(lowest, rotate(conjugate(belt.rotation), at).y);
    }
    EXPECT_GT(lowest, random.halfExtents.y) << substeps << " substeps";
  }
}

}  // namespace brickfall::law
