// What listeners hear: every beginning has one end, impacts carry their impulse, and nothing is told twice or lost.
#include <algorithm>
#include <map>
#include <set>

#include "math/random.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

bool names(const std::vector<BodyId>& list, BodyId body) {
  return std::find(list.begin(), list.end(), body) != list.end();
}

TEST(Events, AFallingBoxBeginsRestsAndSleeps) {
  World world = makeWorld();
  BodyId ground = addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 1, 0});
  int begins = 0, ends = 0, slept = 0;
  double hitSpeed = 0, hitImpulse = 0;
  for (int i = 0; i < 300; i++) {
    stepSound(world);
    const Events& e = world.events();
    for (const ContactEvent& c : e.begin) {
      begins++;
      EXPECT_EQ(c.bodyA, ground);
      EXPECT_EQ(c.bodyB, box);
    }
    ends += int(e.end.size());
    slept += int(names(e.fellAsleep, box));
    for (const HitEvent& h : e.hits) {
      hitSpeed = std::max(hitSpeed, h.approachSpeed);
      hitImpulse += h.impulse;
      expectNear(h.normalWorld, {0, 1, 0}, 1e-6, "normal");
      EXPECT_NEAR(h.pointWorld.y, 0, 0.05);
    }
    if (i < 10) {
      EXPECT_TRUE(names(e.moved, box));
    }
    if (!world.state(box)->awake) {
      EXPECT_FALSE(names(e.moved, box));
    }
  }
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 0);
  EXPECT_EQ(slept, 1);
  double speed = std::sqrt(2 * kG * 0.8);
  EXPECT_NEAR(hitSpeed, speed, 0.2);
  EXPECT_NEAR(hitImpulse, 64 * speed, 64 * speed * 0.3);
}

// A ball that comes and is gone again within one step: all of it is told, and forces as means over the step.
TEST(Events, ABounceWithinAStepIsTold) {
  const double speed = 4, e = 0.5;
  WorldDef def;
  def.gravity = {};
  World world = makeWorld(def);
  ShapeDef floor = boxOf({5, 0.5, 5}), sphere = sphereOf(0.1, 1000);
  floor.material.restitution = sphere.material.restitution = e;
  add(world, bodyOf(floor, {0, -0.5, 0}, BodyType::fixed));
  BodyDef falling = bodyOf(sphere, {0, 0.1 + 1.5 * speed * kDt, 0});
  falling.linearVelocity = {0, -speed, 0};
  BodyId ball = add(world, falling);
  const double mass = world.state(ball)->mass;
  stepSound(world);
  ASSERT_TRUE(world.events().begin.empty());
  stepSound(world);
  EXPECT_NEAR(world.state(ball)->linearVelocity.y, e * speed, 0.01) << "it has bounced";
  ASSERT_EQ(world.events().begin.size(), 1u);
  ASSERT_EQ(world.events().hits.size(), 1u);
  EXPECT_NEAR(world.events().hits[0].approachSpeed, speed, 0.01);
  EXPECT_NEAR(world.events().hits[0].impulse, mass * speed, 0.01 * mass * speed) << "what stopped it";
  double force = 0;
  world.forEachContact([&](const ContactView& c) {
    for (int i = 0; i < c.pointCount; i++) force += c.points[i].normalForce;
  });
  EXPECT_NEAR(force * kDt, (1 + e) * mass * speed, 0.01 * mass * speed) << "and what threw it back";
  int ends = 0, later = 0;
  for (int i = 0; i < 10; i++) {
    stepSound(world);
    ends += int(world.events().end.size());
    later += int(world.events().begin.size() + world.events().hits.size());
  }
  EXPECT_EQ(ends, 1);
  EXPECT_EQ(later, 0);
}

// An impact late in a step and another soon after it: impulses add up to the momentum, whatever part of a step they fall in.
TEST(Events, HitsInPartsOfStepsCarryTheirImpulse) {
  for (double height : {0.3, 0.31, 0.32, 0.33}) {
    World world = makeWorld();
    add(world, bodyOf(boxOf({5, 0.5, 5}), {0, -0.5, 0}, BodyType::fixed));
    BodyId box = addBox(world, {0.2, 0.1, 0.2}, {0, height, 0});
    double told = 0;
    for (int i = 0; i < 30; i++) {
      stepSound(world);
      for (const HitEvent& h : world.events().hits) told += h.impulse;
    }
    const double momentum = world.state(box)->mass * std::sqrt(2 * kG * (height - 0.1));
    EXPECT_NEAR(told, momentum, 0.05 * momentum) << height;
  }
}

TEST(Events, SlowOrWeakImpactsMakeNoHit) {
  for (auto [speed, impulse] : {std::pair{100.0, 0.0}, std::pair{0.0, 1e6}}) {
    WorldDef def;
    def.hitEventSpeed = speed;
    def.hitEventImpulse = impulse;
    World world = makeWorld(def);
    addGround(world);
    addBox(world, {0.2, 0.2, 0.2}, {0, 1, 0});
    for (int i = 0; i < 60; i++) {
      stepSound(world);
      EXPECT_TRUE(world.events().hits.empty());
    }
  }
}

TEST(Events, RestingLoadMakesNoHits) {
  World world = awakeWorld();
  addGround(world);
  for (int i = 0; i < 5; i++) addBox(world, {0.2, 0.2, 0.2}, {0, 0.2 + 0.4 * i, 0});
  for (int i = 0; i < 60; i++) {
    stepSound(world);
    EXPECT_TRUE(world.events().hits.empty());
  }
}

TEST(Events, EndIsToldWhenABodyIsLiftedOff) {
  World world = makeWorld();
  BodyId ground = addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  run(world, 1);
  ASSERT_TRUE(world.applyImpulse(box, {0, 64 * 3, 0}).ok());
  int ends = 0;
  for (int i = 0; i < 5; i++) {
    stepSound(world);
    for (const ContactEvent& c : world.events().end) {
      ends++;
      EXPECT_EQ(c.bodyA, ground);
      EXPECT_EQ(c.bodyB, box);
    }
  }
  EXPECT_EQ(ends, 1);
}

TEST(Events, WhatHappensBetweenStepsIsToldByTheNext) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0}), other = addBox(world, {0.2, 0.2, 0.2}, {3, 0.2, 0});
  BodyId doomed = addBox(world, {0.2, 0.2, 0.2}, {6, 0.2, 0});
  run(world, 1.5);
  ASSERT_FALSE(world.state(box)->awake);
  ASSERT_TRUE(world.wake(box).ok());
  ASSERT_TRUE(world.setTransform(other, {3, 2, 0}, {}).ok());
  ASSERT_TRUE(world.destroyBody(doomed).ok());
  stepSound(world);
  EXPECT_TRUE(names(world.events().woke, box));
  EXPECT_TRUE(names(world.events().woke, other));
  int lifted = 0, destroyed = 0;
  for (const ContactEvent& c : world.events().end) {
    lifted += c.bodyB == other;
    destroyed += c.bodyB == doomed;
  }
  EXPECT_EQ(lifted, 1);
  EXPECT_EQ(destroyed, 1);
  stepSound(world);
  EXPECT_TRUE(world.events().woke.empty()) << "told once";
}

// Over a whole collapse: begins and ends alternate for every pair, sleeping and waking for every body, and at every moment
// what has begun and not ended is what presses.
TEST(Events, BeginAndEndAlternateOverACollapse) {
  World world = makeWorld();
  addGround(world);
  for (int row = 0; row < 6; row++)
    for (int i = 0; i < 3; i++) addBox(world, {0.1, 0.05, 0.1}, {0.2 * i + 0.06 * row, 0.05 + 0.1 * row, 0});
  BodyDef ball = bodyOf(sphereOf(0.15, 3000), {0.3, 0.3, 1.5});
  ball.linearVelocity = {0, 0, -6};
  add(world, ball);
  std::set<std::pair<BodyId, BodyId>> open;
  std::map<BodyId, bool> asleep;
  int begins = 0;
  for (int i = 0; i < 300; i++) {
    stepSound(world);
    for (const ContactEvent& c : world.events().begin) {
      EXPECT_LT(c.bodyA, c.bodyB);
      EXPECT_TRUE(open.insert({c.bodyA, c.bodyB}).second) << "began twice, step " << i;
      begins++;
    }
    for (const ContactEvent& c : world.events().end) EXPECT_EQ(open.erase({c.bodyA, c.bodyB}), 1u) << "step " << i;
    for (BodyId body : world.events().fellAsleep) {
      EXPECT_FALSE(asleep[body]);
      asleep[body] = true;
    }
    for (BodyId body : world.events().woke) {
      EXPECT_TRUE(asleep[body]);
      asleep[body] = false;
    }
    std::set<std::pair<BodyId, BodyId>> pressing;
    world.forEachContact([&](const ContactView& c) {
      double force = 0;
      for (int k = 0; k < c.pointCount; k++) force += c.points[k].normalForce;
      if (force > 0) pressing.insert({std::min(c.bodyA, c.bodyB), std::max(c.bodyA, c.bodyB)});
    });
    EXPECT_EQ(open, pressing) << "step " << i;
    for (BodyId body : world.bodies())
      if (asleep.count(body)) {
        EXPECT_EQ(asleep[body], !world.state(body)->awake);
      }
  }
  EXPECT_GT(begins, 30);
}

TEST(Events, PairsAreNamedInOrderOfCreationEvenInReusedSlots) {
  World world = makeWorld();
  BodyId first = addBox(world, {0.2, 0.2, 0.2}, {0, 5, 0});
  BodyId ground = addGround(world);
  ASSERT_TRUE(world.destroyBody(first).ok());
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.5, 0});  // takes the first slot, but is younger than the ground
  int told = 0;
  for (int i = 0; i < 60; i++) {
    stepSound(world);
    for (const ContactEvent& c : world.events().begin) {
      EXPECT_EQ(c.bodyA, ground);
      EXPECT_EQ(c.bodyB, box);
      told++;
    }
    for (const HitEvent& h : world.events().hits) {
      EXPECT_EQ(h.bodyA, ground);
      EXPECT_GT(h.normalWorld.y, 0.9) << "from A to B";
      told++;
    }
  }
  EXPECT_GE(told, 2);
}

}  // namespace
}  // namespace brickfall
