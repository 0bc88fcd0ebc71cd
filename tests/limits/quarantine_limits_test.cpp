// What becomes non-finite is named and held; whatever it does not touch goes on bit for bit as in a world without it.
#include <algorithm>

#include "scaled_wall.h"

namespace brickfall {
namespace {

using namespace test;

struct Named {
  std::vector<BodyId> bodies;
  bool has(BodyId body) const { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); }
};

// Steps with an absurd force on each victim.
Named torment(World& world, const std::vector<BodyId>& victims, int steps, Vec3 force) {
  Named named;
  for (int i = 0; i < steps; i++) {
    for (BodyId body : victims) (void)world.applyForce(body, force);
    Result<StepReport> report = world.step(kDt);
    EXPECT_TRUE(report.ok());
    if (!report) break;
    named.bodies.insert(named.bodies.end(), report->quarantined.begin(), report->quarantined.end());
    expectSound(world);
  }
  return named;
}

void expectSameBits(const World& a, const World& b, const std::vector<BodyId>& inA, const std::vector<BodyId>& inB) {
  for (std::size_t i = 0; i < inA.size(); i++) {
    BodyState s = *a.state(inA[i]), t = *b.state(inB[i]);
    EXPECT_EQ(s.position, t.position) << i;
    EXPECT_EQ(s.rotation, t.rotation) << i;
    EXPECT_EQ(s.linearVelocity, t.linearVelocity) << i;
    EXPECT_EQ(s.angularVelocity, t.angularVelocity) << i;
  }
}

TEST(QuarantineLimits, WhatDoesNotTouchTheVictimsGoesOnBitForBit) {
  for (bool sleep : {false, true}) {
    SCOPED_TRACE(sleep);
    WorldDef def;
    def.enableSleep = sleep;
    ScaledWall with(0.215, {}, def), without(0.215, {}, def);
    std::vector<BodyId> victims;
    for (int i = 0; i < 4; i++)
      victims.push_back(addBox(with.world, {0.01, 0.01, 0.01}, {3.0 + i, 0.01 + 0.5 * (i % 2), 0}));
    with.shoot(10);
    without.shoot(10);
    Named named = torment(with.world, victims, 60, {1e12, 1e12, 1e12});
    without.runFor(1, kDt);
    EXPECT_EQ(named.bodies.size(), 4u) << "several at once, each named once";
    for (BodyId body : victims) EXPECT_TRUE(named.has(body) && with.world.state(body)->quarantined);
    EXPECT_GT(with.movedBricks(0.1), 0);
    expectSameBits(with.world, without.world, with.bricks, without.bricks);
  }
}

TEST(QuarantineLimits, ABrickAmidAWallIsTakenOutAndTheOthersStayNear) {
  for (bool sleep : {false, true}) {
    WorldDef def;
    def.enableSleep = sleep;
    ScaledWall wall(0.215, {}, def);
    wall.runFor(2, kDt);
    BodyId victim = wall.bricks[27], second = wall.bricks[32];
    EXPECT_EQ(wall.world.state(victim)->awake, !sleep);
    Named named = torment(wall.world, {victim, second}, 60, {1e12, 0, 1e12});
    EXPECT_EQ(named.bodies.size(), 2u);
    EXPECT_TRUE(named.has(victim) && named.has(second));
    for (BodyId body : wall.bricks) {
      BodyState s = *wall.world.state(body);
      EXPECT_TRUE(isFinite(s.position));
      EXPECT_LT(length(s.position), 3) << "m";
    }
    EXPECT_TRUE(wall.world.destroyBody(victim).ok());
    EXPECT_FALSE(wall.world.isValid(victim));
    stepSound(wall.world);
  }
}

// Thousands of m/s against a thin plate: swept as a fast body, then past all bounds.
TEST(QuarantineLimits, DuringContinuousCollision) {
  World world = awakeWorld();
  addGround(world);
  BodyId plate = add(world, bodyOf(boxOf({5, 5, 0.01}), {0, 5, 0}, BodyType::fixed));
  std::vector<BodyId> shots;
  for (int i = 0; i < 3; i++) {
    BodyDef d = bodyOf(boxOf({0.01, 0.01, 0.01}), {double(i), 2, 3});
    d.linearVelocity = {0, 0, -1e4};
    shots.push_back(add(world, d));
  }
  Named named = torment(world, {shots[1]}, 30, {0, 0, -1e12});
  EXPECT_EQ(named.bodies.size(), 1u);
  EXPECT_TRUE(named.has(shots[1]));
  for (BodyId body : {shots[0], shots[2]}) EXPECT_GT(world.state(body)->position.z, -0.02) << "none is through";
  EXPECT_TRUE(world.isValid(plate));
}

TEST(QuarantineLimits, WhoFliesTenThousandKilometresIsNamed) {
  World world = emptySpace();
  BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {9e5, 0, 0});
  d.linearVelocity = {1e5, 0, 0};
  BodyId far = add(world, d);
  Named named = torment(world, {}, 1000, {});
  EXPECT_TRUE(named.bodies.empty()) << "2.6e6 m are fine";
  for (int i = 0; i < 1000; i++) {
    Result<StepReport> report = world.step(0.1);
    ASSERT_TRUE(report.ok());
    named.bodies.insert(named.bodies.end(), report->quarantined.begin(), report->quarantined.end());
  }
  ASSERT_EQ(named.bodies.size(), 1u);
  EXPECT_EQ(named.bodies[0], far);
  EXPECT_LT(world.state(far)->position.x, 1e7);
}

}  // namespace
}  // namespace brickfall
