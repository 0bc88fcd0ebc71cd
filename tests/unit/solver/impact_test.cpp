// Impacts: rebound inside a solve, and impacts at their moment.
#include "solver/impact.h"

#include <cmath>
#include <limits>

#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "solver/prepare.h"
#include "support/test_island.h"

namespace brickfall {
namespace {

using namespace test;

// Of a brick that comes down at 3 m/s, until it goes up again.
struct Landing {
  double speed = 0;  // m/s, upwards
  int steps = 0;
  double angularMomentum = 0;
};
Landing land(double e, double gap) {
  TestIsland lab;
  BodyIndex ground = lab.ground(), brick = lab.brick({0, kBrick.y + gap, 0});
  lab.at(brick).linearVelocity = {0, -3, 0};
  lab.contact(lab.touch(ground, brick)).restitution = float(e);
  Landing out;
  for (; out.steps < 4 && !(out.speed > 0); out.steps++) {
    lab.step();
    out.speed = lab.at(brick).linearVelocity.y;
    out.angularMomentum = length(lab.context.solved[brick].angularMomentum);
  }
  return out;
}

TEST(Rebound, GivesItsShareOfTheImpulseThatStoppedTheImpact) {
  for (double e : {0.2, 0.5, 0.9})
    for (double gap : {0.0, 1e-3, 9e-3}) {
      Landing landing = land(e, gap);
      const double closing = std::sqrt(9 + 2 * kG * gap), h = 1.0 / 60;
      EXPECT_NEAR(landing.speed, e * closing, 0.02 * e * closing + kG * h + (1 + e) * gap / h) << e << ", gap " << gap;
      EXPECT_LT(landing.angularMomentum, 1e-6) << "all four corners alike";
      EXPECT_LE(landing.steps, 2) << "an impact that a step does not end is over in the next";
    }
}

TEST(Rebound, SlowImpactsDoNot) {
  TestIsland lab;
  BodyIndex ground = lab.ground();
  std::vector<BodyIndex> pile = lab.pile(ground, 2);
  lab.at(pile[1]).linearVelocity = {0, -0.5, 0};  // under restitutionSpeed, and not alone
  for (Contact& c : lab.contacts.contacts) c.restitution = 0.9f;
  for (int i = 0; i < 3; i++) {
    lab.step();
    EXPECT_LT(lab.at(pile[1]).linearVelocity.y, 1e-3) << i;
  }
}

TEST(Rebound, TheSmallestRestitutionChangesTheLeast) {
  auto heightOf = [](double e) {
    TestIsland lab;
    BodyIndex ground = lab.ground();
    std::vector<BodyIndex> pile = lab.pile(ground, 3);
    lab.at(pile[2]).linearVelocity = {0.5, -4, 0};
    for (Contact& c : lab.contacts.contacts) c.restitution = float(e);
    lab.run(3);
    return lab.at(pile[2]).position;
  };
  Vec3 none = heightOf(0);
  EXPECT_LT(length(heightOf(1e-6) - none), 1e-6);
  EXPECT_LT(length(heightOf(1e-3) - none), 1e-3);
  EXPECT_GT(heightOf(0.5).y - none.y, 0.02);
}

// The island as StepContext::solved would have it after `dt` s of free motion.
void goOnFreely(TestIsland& lab, double dt) {
  Island& island = lab.island();
  island.dt = dt;
  island.facts = findFacts(island, lab.context);
  island.plan = planFor(island.facts, lab.context.settings, dt);
  for (BodyIndex body : island.bodies) predictFreeMotion(lab.context, lab.bodies, body, dt, false);
  prepareBodies(island, lab.context);
  prepareRows(island, lab.ties(), lab.context);
  for (BodyIndex body : island.bodies) storeFreeBody(body, dt, lab.context);
}

TEST(Impact, IsMetWhenAFallingBodyArrives) {
  for (double speed : {0.0, 0.5, 3.0}) {
    TestIsland lab;
    BodyIndex ground = lab.ground(), brick = lab.brick({0, kBrick.y + 1e-3, 0});
    lab.at(brick).linearVelocity = {0, -speed, 0};
    lab.touch(ground, brick);
    goOnFreely(lab, lab.context.dt);
    double exact = (std::sqrt(speed * speed + 2 * kG * 1e-3) - speed) / kG;
    EXPECT_NEAR(firstClosing(lab.island(), lab.context.dt, lab.context), exact, 1e-6) << speed;
  }
  TestIsland lab;
  BodyIndex ground = lab.ground(), brick = lab.brick({0, kBrick.y + 1e-3, 0});
  lab.at(brick).linearVelocity = {0, 3, 0};
  lab.touch(ground, brick);
  goOnFreely(lab, 1e-3);
  EXPECT_GT(firstClosing(lab.island(), 1e-3, lab.context), 0.6) << "it rises first";
}

struct Knock {
  Vec3 velocity, spin;
  std::size_t impacts = 0;
  double impulse = 0;
  bool solved = false;
};
Knock knock(Vec3 velocity, double friction, double e, double gap = 0) {
  TestIsland lab;
  BodyIndex ground = lab.ground(), cube = lab.brick({0, 0.05 + gap, 0}, 2, {0.05, 0.05, 0.05});
  lab.at(cube).linearVelocity = velocity;
  lab.contact(lab.touch(ground, cube, float(friction))).restitution = float(e);
  Island& island = lab.island();
  island.dt = lab.context.dt;
  updateHierarchy(island, lab.context);
  std::pmr::vector<TieImpact> impacts;
  SolveStatistics statistics;
  Knock out;
  out.solved = solveImpact(island, lab.ties(), lab.bodies, lab.context, 1e-5, statistics, impacts);
  out.velocity = lab.at(cube).linearVelocity;
  out.spin = lab.at(cube).angularVelocity;
  out.impacts = impacts.size();
  for (const TieImpact& impact : impacts) out.impulse += impact.impulse;
  return out;
}

TEST(Impact, StopsWhatComesAndReturnsItsShare) {
  for (double e : {0.0, 0.4, 1.0}) {
    Knock k = knock({0, -2, 0}, 0.5, e);
    ASSERT_TRUE(k.solved);
    EXPECT_EQ(k.impacts, 1u);
    EXPECT_NEAR(k.velocity.y, 2 * e, 1e-4);
    EXPECT_NEAR(k.impulse, 4, 0.01) << "without the rebound";
    EXPECT_LT(length(k.spin), 1e-3);
  }
}

TEST(Impact, RubsByFrictionTimesAllOfItsImpulse) {
  // Too little friction to stop the slide.
  for (double e : {0.0, 0.5}) {
    Knock k = knock({3, -2, 0}, 0.05, e);
    ASSERT_TRUE(k.solved);
    EXPECT_NEAR(k.velocity.x, 3 - 0.05 * 2 * (1 + e), 0.02 * 0.1 * (1 + e));
  }
}

TEST(Impact, LeavesFrictionAnchorsWhereTheyWere) {
  TestIsland lab;
  BodyIndex ground = lab.ground(), brick = lab.brick({0, kBrick.y, 0});
  ContactIndex face = lab.touch(ground, brick);
  PointMemory& m = lab.points(face);
  for (int i = 0; i < 4; i++) {  // it slid, and is pressed on while another corner is hit
    m.phase[i] = PointPhase::resting;
    m.stiffness[i] = float(1000 * lab.unit(face));
    m.forceN[i] = m.multiplierN[i] = float(kBrickWeight / 4);
    m.slip1[i] = m.drift1[i] = 2e-4f;
    m.stickingMask = 0;
  }
  m.drift1[3] = 0;
  lab.at(brick).linearVelocity = {1, -1, 0};
  Island& island = lab.island();
  island.dt = lab.context.dt;
  updateHierarchy(island, lab.context);
  const ContactGeometry before = lab.contacts.geometry[face];
  std::pmr::vector<TieImpact> impacts;
  SolveStatistics statistics;
  ASSERT_TRUE(solveImpact(island, lab.ties(), lab.bodies, lab.context, 1e-5, statistics, impacts));
  for (int i = 0; i < 4; i++) EXPECT_EQ(lab.contacts.geometry[face].anchorA[i], before.anchorA[i]) << i;
}

TEST(Impact, WhatIsApartOrRestsIsLeftAlone) {
  Knock apart = knock({0, -0.01, 0}, 0.5, 0.5, 1e-3);
  EXPECT_EQ(apart.velocity, (Vec3{0, -0.01, 0}));
  EXPECT_EQ(apart.impacts, 0u);
  Knock rest = knock({}, 0.5, 0.5);
  EXPECT_LT(length(rest.velocity), 1e-9);
}

}  // namespace
}  // namespace brickfall
