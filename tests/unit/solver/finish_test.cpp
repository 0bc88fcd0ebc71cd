// What follows the solve: flight, and the balance of spin and energy.
#include <cmath>

#include "math/random.h"
#include "solver/finish/balance.h"
#include "solver/finish/motion.h"
#include "solver/rigid_sum.h"
#include "support/test_island.h"

namespace brickfall {
namespace {

using namespace test;

// Through the solve, with motions stored.
void solveAndStore(TestIsland& lab) {
  lab.prepare();
  lab.checkRest();
  lab.solve();
  lab.store();
}

// Two bricks, one on the other, far from anything fixed.
struct Floating {
  TestIsland lab;
  BodyIndex lower, upper;
  explicit Floating(Vec3 velocity = {}, Vec3 spin = {}) {
    lower = lab.brick({0, 5, 0});
    upper = lab.brick({0.03, 5 + 2 * kBrick.y, 0});
    lab.touch(lower, upper);
    lab.at(lower).linearVelocity = velocity;
    lab.at(upper).angularVelocity = spin;
  }
  RigidSum sum(bool free) const {
    RigidSum out({0, 5, 0});
    for (BodyIndex body : {lower, upper}) {
      const SolvedMotion& s = lab.context.solved[body];
      const FreeMotion& f = lab.context.free[body];
      double m = lab.bodies.mass[body].mass;
      Vec3 way = free ? f.d : s.d, velocity = free ? f.d * (1 / lab.context.dt) : s.velocity;
      out.add(m, lab.bodies.motion[body].position + way, lab.bodies.worldInertia(body), velocity * m,
              free ? f.angularMomentum : s.angularMomentum);
    }
    return out;
  }
};

double kineticEnergy(const TestIsland& lab) {
  double sum = 0;
  for (BodyIndex body : lab.islands.awake.front()->bodies) {
    const SolvedMotion& s = lab.context.solved[body];
    sum += 0.5 * lab.bodies.mass[body].mass * lengthSquared(s.velocity) +
           0.5 * dot(s.angularMomentum, lab.bodies.worldInvInertia(body) * s.angularMomentum);
  }
  return sum;
}

TEST(Flight, AGroupThatNothingSupportsFliesTheExactParabola) {
  Floating f({0, -0.1, 0});
  solveAndStore(f.lab);
  Vec3 way;
  for (BodyIndex body : {f.lower, f.upper}) {
    EXPECT_TRUE(f.lab.context.solved[body].flying);
    way += f.lab.context.solved[body].d * 0.5;
  }
  const double h = f.lab.context.dt;
  EXPECT_NEAR(way.y, -0.05 * h - 0.5 * kG * h * h, 1e-8);
}

TEST(Flight, WhatStandsOnTheGroundDoesNot) {
  TestIsland lab;
  BodyIndex ground = lab.ground();
  std::vector<BodyIndex> pile = lab.pile(ground, 3);
  for (int i = 0; i < 40; i++) lab.step();
  for (BodyIndex body : pile) EXPECT_FALSE(lab.context.solved[body].flying);
}

TEST(Flight, AGroupKeepsItsMomentaAndWhatNothingTouchesFliesOn) {
  Random random(5);
  int pressing = 0, apart = 0;
  for (int n = 0; n < 50; n++) {
    auto vector = [&](double size) {
      return Vec3{random.between(-size, size), random.between(-size, size), random.between(-size, size)};
    };
    Floating f(vector(2), vector(5));
    solveAndStore(f.lab);
    const RigidSum now = f.sum(false), wanted = f.sum(true);
    EXPECT_LT(length(now.velocity() - wanted.velocity()), 1e-13);
    EXPECT_LT(length(now.angularMomentum() - wanted.angularMomentum()), 1e-9 * (1 + length(wanted.angularMomentum())));
    if (f.lab.island().groups.count() == 1) {
      pressing++;
      continue;
    }
    apart++;
    for (BodyIndex body : {f.lower, f.upper}) {
      EXPECT_EQ(f.lab.context.solved[body].velocity, f.lab.context.free[body].d * (1 / f.lab.context.dt));
      EXPECT_EQ(f.lab.context.solved[body].angularMomentum, f.lab.context.free[body].angularMomentum);
    }
  }
  EXPECT_GE(pressing, 10);
  EXPECT_GE(apart, 10);
}

// An island that gained energy by a force from nowhere on one of its bodies.
struct Gained : TestIsland {
  std::vector<BodyIndex> pile;
  double allowed = 0;  // J
  explicit Gained(std::size_t pushed, double weights) {
    BodyIndex floor = ground();
    pile = TestIsland::pile(floor, 30);
    for (int i = 0; i < 5; i++) step();
    at(pile[29]).linearVelocity = {0.5, 0, 0};  // nothing rests
    solveAndStore(*this);
    for (BodyIndex body : pile) {
      const FreeMotion& free = context.free[body];
      allowed += 0.5 * kBrickMass * lengthSquared(free.startVelocity) +
                 0.5 * dot(free.startSpin, bodies.worldInertia(body) * free.startSpin) +
                 kBrickMass * dot(context.gravity, context.solved[body].d);
    }
    for (Wrench& r : island().residual) r = {};
    Vec3 impulse = Vec3{1, 0, 0} * (weights * kBrickMass * kG * context.dt);
    island().residual[pushed].force = toFloat(impulse * (-1 / context.dt));
    context.solved[pile[pushed]].velocity += impulse * (1 / kBrickMass);
  }
};

TEST(Balance, TakesBackWhatAResidualGaveFromTheBodyThatHadIt) {
  Gained lab(29, 20);
  std::vector<Vec3> before;
  for (BodyIndex body : lab.pile) before.push_back(lab.context.solved[body].velocity);
  ASSERT_GT(kineticEnergy(lab), 1.5 * lab.allowed);
  checkEnergy(lab.island(), lab.context);
  EXPECT_NEAR(kineticEnergy(lab), lab.allowed, 1e-3 * lab.allowed);
  for (std::size_t i = 0; i < 29; i++)
    EXPECT_EQ(lab.context.solved[lab.pile[i]].velocity, before[i]) << "has no part in it";
  EXPECT_LT(lab.context.solved[lab.pile[29]].velocity.x, before[29].x);
}

// A residual gave one weight, and something else twice the velocity: all of both goes. All that goes is told,
// but what the residual gave.
TEST(Balance, TakesWhatRemainsBeyondTheResidual) {
  Gained lab(29, 1);
  const BodyIndex top = lab.pile[29];
  SolvedMotion& s = lab.context.solved[top];
  s.velocity *= 3.0;
  const Vec3 fast = s.velocity, impulse{kG * lab.context.dt, 0, 0};
  const double before = kineticEnergy(lab);
  const double ofResidual = 0.5 * kBrickMass * (lengthSquared(fast) - lengthSquared(fast - impulse));
  ASSERT_GT(before - ofResidual, lab.allowed + 0.5);
  const double taken = checkEnergy(lab.island(), lab.context);
  EXPECT_LE(kineticEnergy(lab), lab.allowed * (1 + 1e-4));
  EXPECT_NEAR(before - kineticEnergy(lab), ofResidual + taken, 1e-4 * before);
}

// A pile of three of which the uppermost slides.
struct Sliding : TestIsland {
  std::vector<BodyIndex> bricks;
  double start = 0;  // J
  explicit Sliding(double speed) : start(0.5 * kBrickMass * speed * speed) {
    BodyIndex floor = ground();
    bricks = pile(floor, 3);
    for (int i = 0; i < 5; i++) step();
    at(bricks[2]).linearVelocity = {speed, 0, 0};  // nothing rests
    island().unsettle();
  }
};

TEST(Balance, WhatNothingGaveIsTakenAtAnySpeed) {
  for (double speed : {0.05, 0.15}) {
    Sliding lab(speed);
    solveAndStore(lab);
    for (Wrench& r : lab.island().residual) r = {};
    for (int i = 0; i < 3; i++)  // to and fro: friction can hold what they have in common
      lab.context.solved[lab.bricks[std::size_t(i)]].velocity += Vec3{i == 1 ? -0.2 : 0.2, 0, 0};
    ASSERT_GT(kineticEnergy(lab), 3 * lab.start);
    checkEnergy(lab.island(), lab.context);
    EXPECT_LT(kineticEnergy(lab), 1.05 * lab.start) << "and what weights did in the step";
  }
}

// The pile has been pressed down by more than its weight presses.
TEST(Balance, WhatElasticJointsGiveBackIsTakenFromWhatStandsWhileNothingMovesFast) {
  for (double speed : {0.05, 0.15}) {
    Sliding lab(speed);
    for (int i = 0; i < 4; i++) lab.points(0).gap[std::size_t(i)] -= 6e-3f;
    lab.contact(2).friction = 0;
    solveAndStore(lab);
    const double before = kineticEnergy(lab);
    ASSERT_GT(before, lab.start + 1e-3);
    checkEnergy(lab.island(), lab.context);
    if (speed < 0.1)
      EXPECT_LT(kineticEnergy(lab), 1.05 * lab.start);
    else
      EXPECT_GT(kineticEnergy(lab), 0.999 * before) << "what moves faster keeps it";
  }
}

TEST(Balance, LeavesAloneWhatLost) {
  TestIsland lab;
  BodyIndex ground = lab.ground();
  std::vector<BodyIndex> pile = lab.pile(ground, 3);
  lab.at(pile[2]).linearVelocity = {0.5, 0, 0};
  solveAndStore(lab);
  std::vector<Vec3> before;
  for (BodyIndex body : pile) before.push_back(lab.context.solved[body].velocity *= 0.5);
  checkEnergy(lab.island(), lab.context);
  for (std::size_t i = 0; i < pile.size(); i++) EXPECT_EQ(lab.context.solved[pile[i]].velocity, before[i]);
}

TEST(Balance, AWayCutOffAtAnObstacleIsNoGain) {
  TestIsland lab;
  BodyIndex ground = lab.ground();
  BodyIndex low = lab.brick({0, kBrick.y, 0}), high = lab.brick({0.05, 3 * kBrick.y + 1e-3, 0});
  lab.touch(ground, low);
  lab.touch(low, high);
  lab.at(high).linearVelocity = {3, 2, 0};
  solveAndStore(lab);
  Vec3 velocity = lab.context.solved[high].velocity;
  shorten(high, 0.1, 1, {}, false, lab.context);  // as stopAtObstacles does
  checkEnergy(lab.island(), lab.context);
  EXPECT_LT(length(lab.context.solved[high].velocity - velocity), 1e-9);
}

}  // namespace
}  // namespace brickfall
