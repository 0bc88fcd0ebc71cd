// Bodies that are driven: they are where their path has them, at any time step, and rest before and after.
#include "brickfall/machines.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

BodyId addTable(World& world, Vec3 at = {0, -0.1, 0}) {
  return add(world, bodyOf(boxOf({2, 0.1, 2}, 1000, 0.7), at, BodyType::kinematic));
}

void stepWith(Machines& machines, World& world, double dt = kDt) {
  ASSERT_TRUE(machines.act(world, world.time(), dt).ok());
  stepSound(world, dt);
}

TEST(Machines, ABodyIsWhereItsPathHasIt) {
  World world = makeWorld();
  const BodyId table = addTable(world);
  Machines machines;
  MotionPath path{{{0.1, {0, -0.1, 0}, {}}, {1, {1, 0.5, 0}, quatFromAxisAngle({0, 1, 0}, 1)}, {2, {0, 0, 1}, {}}}, {}};
  ASSERT_TRUE(machines.follow(world, table, path).ok());
  double dt = kDt;
  while (world.time() < 2.3) {
    stepWith(machines, world, dt);
    dt = dt == kDt ? kDt / 1.5 : kDt;
    const Transform pose = path.at(world.time());
    EXPECT_LT(length(world.state(table)->position - pose.position), 1e-9);
    EXPECT_LT(length(rotationVector(normalized(world.state(table)->rotation * conjugate(pose.rotation)))), 1e-9);
  }
  EXPECT_EQ(world.state(table)->linearVelocity, Vec3{});
  EXPECT_EQ(world.state(table)->angularVelocity, Vec3{});
}

// A body of two unlike parts turns about its origin, not about its centre of mass.
TEST(Machines, ABodyTurnsAboutItsOrigin) {
  World world = makeWorld();
  BodyDef hammer = bodyOf(boxOf({1, 0.1, 0.1}), {0, 3, 0}, BodyType::kinematic);
  hammer.shapes.push_back(boxOf({0.2, 0.3, 0.3}, 8000));
  hammer.shapes[1].local.position = {1, 0, 0};
  const BodyId body = add(world, hammer);
  for (int k = 1; k <= 60; k++) {
    ASSERT_TRUE(driveTo(world, body, {{0, 3, 0}, quatFromAxisAngle({0, 0, 1}, 0.05 * k)}, kDt).ok());
    stepSound(world);
    EXPECT_LT(length(world.state(body)->position - Vec3{0, 3, 0}), 1e-9);
  }
  EXPECT_FALSE(driveTo(world, body, {}, 0).ok());
  EXPECT_FALSE(driveTo(world, addBox(world, {1, 1, 1}, {9, 9, 9}), {}, kDt).ok());
}

// A brick on the table sleeps before the machine begins and soon after it ends; while it is moved it is carried along.
TEST(Machines, WhatRestsGoesOnRestingBeforeAndAfter) {
  World world = makeWorld();
  const BodyId table = addTable(world), brick = addBox(world, {0.1, 0.03, 0.05}, {0.5, 0.03, 0});
  Machines machines;
  Shake shake;
  shake.start = 2, shake.amplitude = 1, shake.seconds = 2, shake.ramp = 0.5, shake.frequency = 2;
  ASSERT_TRUE(machines.shake(world, table, shake).ok());
  ASSERT_TRUE(machines.tilt(world, table, {.angle = {{{2, 0}, {3, 0.2}}, {}}}).ok());
  bool slept = false, woke = false;
  while (world.time() < 6) {
    stepWith(machines, world);
    const bool awake = world.state(brick)->awake;
    if (world.time() < 1.9) slept = slept || !awake;
    if (world.time() > 2.1 && world.time() < 4) woke = woke || awake;
  }
  EXPECT_TRUE(slept && woke);
  EXPECT_FALSE(world.state(brick)->awake);
  const Transform pose{world.state(table)->position, world.state(table)->rotation};
  EXPECT_LT(length(transformPoint(inverse(pose), world.state(brick)->position) - Vec3{0.5, 0.13, 0}), 1e-3);
  EXPECT_NEAR(rotationVector(pose.rotation).z, 0.2, 1e-12);
}

TEST(Machines, LoadsTurnInTheFrameOfTheGround) {
  World world = makeWorld();
  addGround(world);
  const BodyId brick = addBox(world, {0.1, 0.03, 0.05}, {0, 0.03, 0});
  Machines machines;
  ASSERT_TRUE(machines.tiltAll(world, {.angle = {{{1, 0}, {2, 0.3}}, {}}}).ok());
  Shake pulse;
  pulse.signal = ShakeSignal::squarePulse, pulse.start = 3, pulse.seconds = 0.5, pulse.amplitude = 2;
  ASSERT_TRUE(machines.shakeAll(world, pulse).ok());
  while (world.time() < 0.9) stepWith(machines, world);
  EXPECT_FALSE(world.state(brick)->awake);
  while (world.time() < 2.5) stepWith(machines, world);
  EXPECT_NEAR(world.gravity().x, -kG * std::sin(0.3), 1e-9) << "the ground's +x side is lifted";
  while (world.time() < 3.2) stepWith(machines, world);
  EXPECT_NEAR(world.gravity().x, -kG * std::sin(0.3) - 2, 1e-9);
  while (world.time() < 5) stepWith(machines, world);
  EXPECT_NEAR(world.gravity().x, -kG * std::sin(0.3), 1e-9);
  EXPECT_FALSE(world.state(brick)->awake);
}

TEST(Machines, BlastsGoOffOnceAtTheirTime) {
  World world = emptySpace();
  const BodyId box = addBox(world, {0.1, 0.1, 0.1}, {1, 0, 0});
  Machines machines;
  ASSERT_TRUE(machines.add(Blast{.centre = {}, .impulse = 10, .radius = 3, .time = 0.5}).ok());
  while (world.time() < 0.49) stepWith(machines, world);
  EXPECT_EQ(world.state(box)->linearVelocity.x, 0);
  stepWith(machines, world);
  stepWith(machines, world);
  const double speed = world.state(box)->linearVelocity.x;
  EXPECT_GT(speed, 0);
  while (world.time() < 1) stepWith(machines, world);
  EXPECT_EQ(world.state(box)->linearVelocity.x, speed);
}

TEST(Machines, RefuseWhatCannotBeDone) {
  World world = makeWorld();
  const BodyId table = addTable(world), box = addBox(world, {1, 1, 1}, {0, 3, 0});
  Machines machines;
  const MotionPath path{{{0, {}, {}}, {1, {1, 0, 0}, {}}}, {}};
  EXPECT_FALSE(machines.follow(world, box, path).ok());
  EXPECT_FALSE(machines.follow(world, BodyId{}, path).ok());
  EXPECT_FALSE(machines.follow(world, table, {}).ok());
  EXPECT_FALSE(machines.follow(world, table, {{{1, {}, {}}, {1, {}, {}}}, {}}).ok());
  EXPECT_FALSE(machines.follow(world, table, {{{0, {NAN, 0, 0}, {}}}, {}}).ok());
  EXPECT_FALSE(machines.follow(world, table, {{{0, {}, {}}, {1e-3, {100, 0, 0}, {}}}, {}}).ok());
  EXPECT_FALSE(machines.tilt(world, table, {.axis = {}, .angle = {{{0, 0}}, {}}}).ok());
  EXPECT_FALSE(machines.tilt(world, table, {.angle = {{{0, NAN}}, {}}}).ok());
  EXPECT_FALSE(machines.add(Wind{.velocity = {INFINITY, 0, 0}}).ok());
  EXPECT_FALSE(machines.add(Wind{.velocity = {1, 0, 0}, .from = 2, .until = 1}).ok());
  EXPECT_FALSE(machines.add(Blast{.impulse = NAN}).ok());
  EXPECT_TRUE(machines.empty());
  EXPECT_FALSE(machines.act(world, 0, NAN).ok());
}

}  // namespace
}  // namespace brickfall
