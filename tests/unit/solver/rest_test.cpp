// How islands come to rest: what stops them, exactly when, and what never does.
#include "solver/rest.h"

#include <gtest/gtest.h>

#include "solver/finish/motion.h"
#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kBrickWeight;
using test::OnGround;
using test::TestIsland;

TEST(Rest, OnlyUnderTheToleranceOfTheResidual) {
  for (double error : {0.0, 0.9e-3, -0.9e-3, 1.1e-3, -1.1e-3, 0.5}) {
    OnGround lab;
    lab.load(lab.face, (1 + error) * kBrickWeight, 1e4 * lab.unit(lab.face));  // one calm body: 10 x 1000 u
    lab.prepare();
    lab.checkRest();
    bool rests = std::fabs(error) < 1e-3;
    EXPECT_EQ(lab.island().ending, rests ? IslandEnding::rested : IslandEnding::unsolved) << error;
    EXPECT_EQ(lab.context.statistics.restingIslands, int(rests));
    for (const SolveMotion& m : lab.island().motion)
      EXPECT_TRUE(m.d == Vec3f{} && m.th == Vec3f{}) << "no motion is judged";
  }
}

TEST(Rest, TorqueIsAForceAtTheInnerRadius) {
  for (double share : {0.9, 1.1}) {
    OnGround lab;
    lab.load(lab.face, kBrickWeight, 1e4 * lab.unit(lab.face));
    lab.bodies.data[lab.body].torque = {0, share * 1e-3 * kBrickWeight * kBrick.y, 0};
    lab.prepare();
    lab.checkRest();
    EXPECT_EQ(lab.island().resting(), share < 1) << share;
  }
}

TEST(Rest, NotWhileAnythingIsFasterThanTheRestSpeed) {
  OnGround lab;
  lab.load(lab.face, kBrickWeight, 1e4 * lab.unit(lab.face));
  lab.at(lab.body).linearVelocity = {0.0101, 0, 0};
  lab.prepare();
  lab.checkRest();
  EXPECT_EQ(lab.island().ending, IslandEnding::unsolved);
}

TEST(Rest, KineticDampingStopsAtAMaximumOfTheEnergyAndNowhereElse) {
  for (int bodies : {1, 2}) {
    TestIsland lab;
    std::vector<BodyIndex> pile = lab.pile(lab.ground(), bodies);
    lab.island();
    int above = bodies;
    for (ContactIndex k : lab.island().rows.contacts.tieOf) lab.load(k, above-- * kBrickWeight, 1e4 * lab.unit(k));
    const double speeds[] = {1e-3, 2e-3, 2e-3, 5e-3, 9e-3, 8.99e-3, 8.8e-3, 8e-3};  // m/s
    for (double v : speeds) {
      for (BodyIndex body : pile) lab.at(body).linearVelocity = {v, 0, 0};
      for (int k = 0; k < bodies; k++) lab.contact(std::size_t(k)).touching = true;
      lab.prepare();
      bool passed = v == 8.8e-3;  // 0.2 % of the energy is none; after a stop it grows again
      for (BodyIndex body : pile) {
        EXPECT_EQ(lab.at(body).linearVelocity.x, passed ? 0 : v) << v;
        EXPECT_EQ(lab.context.free[body].startVelocity.x, passed ? 0 : v) << "free motion goes on from there";
      }
    }
  }
}

// What rolls up a slope has passed no maximum; nor has what was given a velocity.
TEST(Rest, KineticDampingLeavesWhatOnlyLosesEnergy) {
  OnGround lab;
  lab.load(lab.face, kBrickWeight, 1e4 * lab.unit(lab.face));
  for (double v : {5e-3, 9e-3, 5e-3, 1.1e-3, 1e-4}) {
    if (v == 9e-3) lab.bodies.data[lab.body].turnEnergy = BodyData{}.turnEnergy;
    lab.at(lab.body).linearVelocity = {v, 0, 0};
    lab.contact(0).touching = true;
    lab.prepare();
    EXPECT_EQ(lab.at(lab.body).linearVelocity.x, v);
  }
}

// On smooth ground momentum along it is no vibration, nor is any that the ground does not press on.
TEST(Rest, KineticDampingLeavesTheSlideThatSupportsCannotTake) {
  for (double friction : {0.6, 0.01, 0.0})
    for (bool pressed : {true, false}) {
      TestIsland lab;
      BodyIndex under = lab.ground(), lower = lab.brick({0, kBrick.y, 0}), upper = lab.brick({0, 3 * kBrick.y, 0});
      ContactIndex foot = lab.touch(under, lower, friction), joint = lab.touch(lower, upper);
      for (double share : {0.5, 1.0, 0.9}) {
        if (pressed) lab.load(foot, 2 * kBrickWeight, 1e4 * lab.unit(foot));
        lab.load(joint, kBrickWeight, 1e4 * lab.unit(joint));
        lab.at(lower).linearVelocity = {8e-3 * share, -1e-3 * share, 0};
        lab.at(upper).linearVelocity = {4e-3 * share, -1e-3 * share, 0};
        lab.prepare();
      }
      double takes = friction * test::kG * lab.context.dt;  // m/s, within the step
      Vec3 left = pressed ? Vec3{std::max(0.0, 5.4e-3 - takes), 0, 0} : Vec3{5.4e-3, -0.9e-3, 0};
      for (BodyIndex body : {lower, upper})
        EXPECT_NEAR(length(lab.at(body).linearVelocity - left), 0, 1e-8) << friction << ", " << pressed;
    }
}

TEST(Rest, KineticDampingLeavesWhatNothingPressesOn) {
  OnGround lab;
  for (double v : {5e-3, 9e-3, 8e-3}) {
    lab.at(lab.body).linearVelocity = {0, -v, 0};
    lab.contact(0).touching = false;
    lab.prepare();
    EXPECT_EQ(lab.at(lab.body).linearVelocity.y, -v) << "it falls";
  }
}

TEST(Rest, KineticDampingLeavesWhatGainsEnergyOrIsFastOrFloats) {
  OnGround topples;
  for (int step = 0; step < 50; step++) {  // ever faster
    topples.at(topples.body).angularVelocity = {1e-3 * step, 0, 0};
    topples.prepare();
    EXPECT_EQ(topples.at(topples.body).angularVelocity.x, 1e-3 * step);
  }
  OnGround fast;
  for (double v : {1.0, 2.0, 1.0, 0.02}) {
    fast.at(fast.body).linearVelocity = {v, 0, 0};
    fast.prepare();
    EXPECT_EQ(fast.at(fast.body).linearVelocity.x, v);
  }
  TestIsland space;
  BodyIndex a = space.brick({}), b = space.brick({0, 2 * kBrick.y, 0});
  space.touch(a, b);
  for (double v : {2e-3, 5e-3, 4e-3}) {
    space.at(a).linearVelocity = {v, 0, 0};
    space.prepare();
    EXPECT_EQ(space.at(a).linearVelocity.x, v) << "nothing holds it";
  }
}

TEST(Rest, ALargeIslandThatSwaysIsStoppedWhenItHasSwungThroughItsMiddle) {
  for (int bricks : {60, 90}) {
    TestIsland row;
    BodyIndex under = row.ground();
    std::vector<BodyIndex> bodies;
    std::vector<ContactIndex> feet;
    for (int i = 0; i < bricks; i++) {
      bodies.push_back(row.brick({2 * kBrick.x * i, kBrick.y, 0}));
      feet.push_back(row.touch(under, bodies.back()));
      if (i > 0) row.touch(bodies[bodies.size() - 2], bodies.back());
    }
    struct Step {
      double speed;  // m/s
      bool stops;
    };
    for (Step step :
         {Step{0.020, false}, {0.025, false}, {0.0249, false}, {0.0245, true}, {0.05, false}, {0.04, false}}) {
      for (BodyIndex body : bodies) row.at(body).linearVelocity = {0, 0, step.speed};
      for (ContactIndex foot : feet) row.load(foot, kBrickWeight, 1000 * row.unit(foot));
      row.prepare();
      EXPECT_EQ(row.at(bodies[3]).linearVelocity.z, step.stops && bricks > 80 ? 0 : step.speed)
          << bricks << " bricks at " << step.speed << " m/s";
    }
  }
}

// Steps of restInPlace alone, for an island that its solve leaves unbalanced; `place`: where the brick is in that step.
template <class Place> int stepsUntilInPlace(OnGround& lab, int most, Place place) {
  Vec3 start = lab.at(lab.body).position;
  for (int step = 1; step <= most; step++) {
    lab.prepare();
    lab.island().ending = IslandEnding::unbalanced;
    lab.context.solved[lab.body].d = {1, 1, 1};
    lab.at(lab.body).position = start + place(step);
    restInPlace(lab.island(), lab.context);
    if (lab.island().ending == IslandEnding::inPlace) return step;
  }
  return -1;
}

TEST(Rest, InPlaceAfterHalfASecondWithinTwentyMicrometres) {
  for (double dt : {1.0 / 64, 1.0 / 128}) {  // exact in binary: sums of steps have no rounding
    OnGround lab({}, 0, dt);
    int steps = stepsUntilInPlace(lab, 200, [](int n) { return Vec3{n % 2 ? 19e-6 : 0, 0, 0}; });
    EXPECT_EQ(steps, int(0.5 / dt)) << "not a step sooner";
    storeMotion(lab.island(), lab.context);
    const SolvedMotion& s = lab.context.solved[lab.body];
    EXPECT_TRUE(s.rest && s.d == Vec3{} && s.velocity == Vec3{} && !s.freeTurn);
  }
}

TEST(Rest, GoingFurtherBeginsTheWatchAnew) {
  constexpr double kStep = 1.0 / 64;
  OnGround once({}, 0, kStep);
  EXPECT_EQ(stepsUntilInPlace(once, 200, [](int n) { return Vec3{0, n < 20 ? 0 : 21e-6, 0}; }), 19 + 32);
  OnGround creeps({}, 0, kStep);  // 1 mm/s: 15.6 um a step
  EXPECT_EQ(stepsUntilInPlace(creeps, 500, [](int n) { return Vec3{0, 0, 15.6e-6 * n}; }), -1);
  OnGround starts({}, 0, kStep);  // falls slowly at 2e-5 g: 24.5 um in 0.5 s, then faster
  EXPECT_EQ(stepsUntilInPlace(starts, 500,
                              [](int n) {
                                return Vec3{0, 0.5 * 2.2e-5 * 9.81 * n * n * kStep * kStep, 0};
                              }),
            -1);
}

TEST(Rest, ATurnCountsAtTheOuterRadius) {
  double reach = length(kBrick);
  for (double share : {0.9, 1.1}) {
    OnGround lab({}, 0, 1.0 / 64);
    int steps = stepsUntilInPlace(lab, 40, [&](int n) {
      double turn = n % 2 ? share * 20e-6 / reach : 0;
      lab.bodies.setRotation(lab.body, quatFromRotationVector(Vec3{0, turn, 0}));
      return Vec3{};
    });
    EXPECT_EQ(steps, share < 1 ? 32 : -1) << share;
  }
}

TEST(Rest, WhatIsNotSlowIsNotWatched) {
  OnGround lab({}, 0, 1.0 / 64);
  EXPECT_EQ(stepsUntilInPlace(lab, 31, [](int) { return Vec3{}; }), -1);
  lab.at(lab.body).linearVelocity = {0.5, 0, 0};
  lab.prepare();
  restInPlace(lab.island(), lab.context);
  EXPECT_TRUE(lab.island().placePoses.empty());
  lab.at(lab.body).linearVelocity = {};
  EXPECT_EQ(stepsUntilInPlace(lab, 200, [](int) { return Vec3{}; }), 32) << "from the beginning";
}

}  // namespace
}  // namespace brickfall
