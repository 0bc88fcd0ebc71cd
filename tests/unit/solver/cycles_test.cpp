// The multilevel solve: forces of a stack under load, honest starts, stops, momentum.
#include "solver/cycles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"
#include "solver/light_pass.h"
#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kBrickMass;
using test::kBrickWeight;
using test::kG;
using test::TestIsland;

// Each joint of a stack carries all that is above it. A body's residual at rest is under 1e-3 weights, so the joint under n of
// them is right to n times that.
TEST(Cycles, AStackUnderLoadComesToItsForces) {
  for (int bricks : {1, 5, 12, 30}) {
    TestIsland lab;
    std::vector<BodyIndex> pile = lab.pile(lab.ground(), bricks);
    const double load = 10 * kBrickWeight;
    for (int step = 0; step < 300; step++) {
      lab.bodies.data[pile.back()].force = {0, -load, 0};
      lab.step();
    }
    EXPECT_TRUE(lab.island().resting()) << bricks;
    for (int i = 0; i < bricks; i++) {
      double wanted = (bricks - i) * kBrickWeight + load;
      EXPECT_NEAR(lab.pressure(ContactIndex(i)), wanted, 1e-3 * wanted) << "joint " << i << " of " << bricks;
    }
    // Elastic: each joint gives f / (sum of its stiffness). 10 x 1000 u while it is one of at most 24 calm bodies.
    if (bricks > 24) continue;
    double sag = 0;
    for (int i = 0; i < bricks; i++) {
      double k = 0;
      for (float each : lab.points(ContactIndex(i)).stiffness) k += double(each);
      sag += ((bricks - i) * kBrickWeight + load) / k;
    }
    double top = lab.at(pile.back()).position.y;
    EXPECT_NEAR((2 * bricks - 1) * kBrick.y - top, sag, 0.02 * sag + 1e-7) << bricks;
  }
}

// What was counted before it, of other islands, is no input of a solve.
TEST(Cycles, CountsAreNoInput) {
  std::vector<SolveMotion> motions[2];
  for (double counted : {0.0, 1e20}) {  // so many that one visit more is lost in rounding
    TestIsland lab;
    std::vector<BodyIndex> pile = lab.pile(lab.ground(), 90);
    for (BodyIndex body : pile) lab.at(body).linearVelocity = {0.2, 0, 0};
    lab.prepare();
    ASSERT_TRUE(lab.island().plan.large);
    SolveStatistics statistics;
    statistics.solveSides = statistics.lightVisits = counted;
    updateHierarchy(lab.island(), lab.context);
    runCycles(lab.island(), lab.context, statistics);
    motions[counted > 0].assign(lab.island().motion.begin(), lab.island().motion.end());
  }
  for (std::size_t i = 0; i < motions[0].size(); i++) {
    EXPECT_EQ(motions[0][i].d, motions[1][i].d) << i;
    EXPECT_EQ(motions[0][i].th, motions[1][i].th) << i;
  }
}

// Any other start cheats: what falls or slides would be glued in place by what cycles leave undone.
TEST(Cycles, StartFromFreeMotion) {
  TestIsland lab;
  std::vector<BodyIndex> pile = lab.pile(lab.ground(), 6);
  lab.at(pile[3]).linearVelocity = {1, 0, 0};
  lab.at(pile[4]).angularVelocity = {0, 2, 0};
  lab.prepare();
  Island& island = lab.island();
  island.plan.direct = false;
  island.plan.minCycles = island.plan.maxCycles = 0;
  island.residual.assign(6, {});  // which no pass has found
  for (std::size_t i = 0; i < 6; i++) island.motion[i] = {{1, 2, 3}, 0, {4, 5, 6}, 0};
  lab.solve();
  for (std::size_t i = 0; i < 6; i++) {
    EXPECT_EQ(island.motion[i].d, island.masses[i].dFree);
    EXPECT_EQ(island.motion[i].th, island.masses[i].thFree);
  }
  EXPECT_EQ(island.motion[6].d, Vec3f{}) << "the ground stays where it is";
}

// In a large island on the ground each body goes on with as much of its fall as it had in the step before.
TEST(Cycles, BodiesOfALargeIslandOnTheGroundStartFromWhereTheirVelocitiesLead) {
  for (float speed : {0.02f, 0.005f}) {
    TestIsland lab;
    std::vector<BodyIndex> pile = lab.pile(lab.ground(), 100);
    for (BodyIndex body : pile) lab.at(body).linearVelocity = {double(speed), 0, 0};
    lab.prepare();
    Island& island = lab.island();
    ASSERT_FALSE(island.plan.startsFree);
    startCycles(island, lab.context);
    for (std::size_t i = 0; i < pile.size(); i++) {
      EXPECT_EQ(island.motion[i].d.y, 0) << i;
      EXPECT_NEAR(island.motion[i].d.x, speed * float(lab.context.dt), 1e-8f) << i;
    }
  }
}

// Where all that presses on the ground rolls or slides, each body goes on with the whole change of velocity that it had,
// up to that of free motion.
TEST(Cycles, BodiesOfAnIslandThatNothingPinsStartWithTheAccelerationThatTheyHad) {
  for (bool pinned : {false, true}) {
    TestIsland lab;
    std::vector<BodyIndex> pile = lab.pile(lab.ground(), 100);
    const double had[] = {-3, 5, 2 * kG};
    for (std::size_t i = 0; i < pile.size(); i++) {
      lab.at(pile[i]).linearVelocity = {0.02, 0, 0};
      lab.bodies.data[pile[i]].linearAcceleration = {had[i % 3], 0, 0};
    }
    lab.prepare();
    for (Contact& contact : lab.contacts.contacts) {
      contact.touching = true;
      contact.points.stickingMask = pinned;
    }
    lab.prepare();
    Island& island = lab.island();
    ASSERT_EQ(island.plan.goesOn, !pinned);
    startCycles(island, lab.context);
    for (std::size_t i = 0; i < pile.size(); i++) {
      const double acceleration = pinned ? 0 : std::min(had[i % 3], kG), h = lab.context.dt;
      EXPECT_NEAR(island.motion[i].d.x, 0.02 * h + acceleration * h * h, 1e-7) << i;
    }
  }
}

// One that may be stopped starts from where it is: the motion that it had is forces on its stiff joints.
TEST(Cycles, LeaveAloneWhatDoesNotReachEachOther) {
  TestIsland lab;
  BodyIndex a = lab.brick({}), b = lab.brick({0, 2 * kBrick.y + 5e-3, 0});
  lab.touch(a, b);
  lab.at(b).linearVelocity = {0.3, 0, 0};
  lab.prepare();
  SolveStatistics counts = lab.solve();
  for (std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(double(length(lab.island().motion[i].d - lab.island().masses[i].dFree)), 0, 1e-9);
    EXPECT_NEAR(double(length(lab.island().motion[i].th)), 0, 1e-9);
  }
  EXPECT_EQ(counts.cycles, 1);
  EXPECT_EQ(counts.solveSides, 0) << "what is in balance costs nothing ...";
  EXPECT_EQ(counts.lightVisits, 2 * 4) << "... but a look at it before and after";
}

TEST(Cycles, EndWhenBalancedOrWhenTheyAreUsedUp) {
  for (bool direct : {false, true})
    for (int most : {4, 400}) {
      TestIsland lab;
      lab.pile(lab.ground(), 6);
      lab.prepare();
      SolvePlan& plan = lab.island().plan;
      plan.direct = direct;
      plan.maxCycles = most;
      SolveStatistics counts = lab.solve();
      double left = worstResidual(lab.island(), lab.bodies);
      bool balanced = left < 5e-4;
      EXPECT_EQ(lab.island().ending, balanced ? IslandEnding::balanced : IslandEnding::unbalanced) << left;
      EXPECT_EQ(balanced, direct || most == 400) << left;
      EXPECT_GE(counts.cycles, 4);
      EXPECT_NEAR(counts.residualRms, rmsResidual(lab.island(), lab.bodies), 1e-12);
    }
}

// A hit in empty space: after the solve the pair has the momentum of the one that came.
TEST(Cycles, AHitHandsOnAllOfItsMomentum) {
  TestIsland lab;
  lab.context.gravity = {};
  std::vector<BodyIndex> row;
  for (int i = 0; i < 40; i++) {
    row.push_back(lab.brick({2 * i * kBrick.x, 0, 0.03 * (i % 3)}));
    if (i > 0) lab.touch(row[std::size_t(i) - 1], row.back());
  }
  lab.at(row[0]).linearVelocity = {10, 0, 0};
  for (int i = 0; i < 5; i++) lab.step();
  Vec3 momentum;
  for (BodyIndex body : row) momentum += lab.at(body).linearVelocity * kBrickMass;
  EXPECT_NEAR(length(momentum - Vec3{10 * kBrickMass, 0, 0}), 0, 1e-6 * 10 * kBrickMass);
}

}  // namespace
}  // namespace brickfall
