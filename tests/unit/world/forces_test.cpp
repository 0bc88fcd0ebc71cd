// Forces, impulses, gravity, damping and drag, each against its closed form.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Forces, ConstantForceGivesConstantAcceleration) {
  for (int substeps : {1, 3}) {
    World world = emptySpace();
    BodyId body = addBox(world, {0.1, 0.1, 0.1}, {});  // 8 kg
    for (int i = 0; i < 60; i++) {
      ASSERT_TRUE(world.applyForce(body, {8, -4, 2}).ok());
      stepSound(world, kDt, substeps);
    }
    expectNear(world.state(body)->linearVelocity, {1, -0.5, 0.25}, 1e-12, "velocity");
  }
}

TEST(Forces, AForceActsForOneStepOnly) {
  World world = emptySpace();
  BodyId body = addBox(world, {0.1, 0.1, 0.1}, {});
  ASSERT_TRUE(world.applyForce(body, {480, 0, 0}).ok());
  stepSound(world);
  double after = world.state(body)->linearVelocity.x;
  EXPECT_NEAR(after, 1, 1e-12);
  run(world, 0.5);
  EXPECT_EQ(world.state(body)->linearVelocity.x, after);
}

TEST(Forces, OffCentreForceTurns) {
  World world = emptySpace();
  BodyId body = addBox(world, {0.1, 0.1, 0.1}, {1, 1, 1});
  ASSERT_TRUE(world.applyForceAtPoint(body, {0, 60, 0}, {1.1, 1, 1}).ok());
  stepSound(world);
  double inertia = 8 * 2 * 0.04 / 12;
  expectNear(world.state(body)->linearVelocity, {0, 60 * kDt / 8, 0}, 1e-12);
  expectNear(world.state(body)->angularVelocity, {0, 0, 60 * 0.1 * kDt / inertia}, 1e-9);
}

TEST(Forces, ImpulsesActAtOnce) {
  World world = emptySpace();
  BodyId body = addBox(world, {0.1, 0.1, 0.1}, {1, 1, 1});
  ASSERT_TRUE(world.applyImpulse(body, {8, 0, 0}).ok());
  expectNear(world.state(body)->linearVelocity, {1, 0, 0}, 1e-15);
  double inertia = 8 * 2 * 0.04 / 12;
  ASSERT_TRUE(world.applyAngularImpulse(body, {0, inertia * 3, 0}).ok());
  expectNear(world.state(body)->angularVelocity, {0, 3, 0}, 1e-12);
  ASSERT_TRUE(world.applyImpulseAtPoint(body, {0, 0, 4}, {1, 1.1, 1}).ok());
  expectNear(world.state(body)->linearVelocity, {1, 0, 0.5}, 1e-12);
  expectNear(world.state(body)->angularVelocity, {4 * 0.1 / inertia, 3, 0}, 1e-12);
}

TEST(Forces, PendingForceDoesNotOutliveAChangeOfType) {
  World world = emptySpace();
  BodyId body = addBox(world, {0.1, 0.1, 0.1}, {});
  ASSERT_TRUE(world.applyForce(body, {480, 0, 0}).ok());
  ASSERT_TRUE(world.setType(body, BodyType::fixed).ok());
  stepSound(world);
  ASSERT_TRUE(world.setType(body, BodyType::dynamic).ok());
  stepSound(world);
  EXPECT_EQ(world.state(body)->linearVelocity, (Vec3{}));
}

TEST(Forces, FreeFallIsTheExactParabola) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    World world = makeWorld();
    BodyId body = addBox(world, {0.1, 0.1, 0.1}, {0, 100, 0}, {3, 4, 0});
    run(world, 1, dt);
    expectNear(world.state(body)->position, {3, 100 + 4 - kG / 2, 0}, 1e-9);
  }
}

TEST(Forces, GravityScale) {
  World world = makeWorld();
  for (double scale : {0.0, -1.0, 2.5}) {
    BodyId body = addBox(world, {0.1, 0.1, 0.1}, {scale * 10, 100, 0});
    ASSERT_TRUE(world.setGravityScale(body, scale).ok());
  }
  run(world, 1);
  for (BodyId body : world.bodies()) {
    double scale = world.state(body)->position.x / 10;
    EXPECT_NEAR(world.state(body)->position.y, 100 - scale * kG / 2, 1e-9);
  }
}

TEST(Forces, GravityCanChangeAndWakesWhatSleeps) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.1, 0.1, 0.1}, {0, 0.1, 0});
  run(world, 1);
  ASSERT_FALSE(world.state(box)->awake);
  ASSERT_TRUE(world.setGravity({0, 1, 0}).ok());
  EXPECT_EQ(world.gravity(), (Vec3{0, 1, 0}));
  run(world, 1);
  EXPECT_NEAR(world.state(box)->position.y, 0.1 + 0.5, 0.02);
}

TEST(Forces, DampingDecaysExponentially) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    World world = emptySpace();
    BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {});
    d.linearVelocity = {10, 0, 0};
    d.angularVelocity = {0, 5, 0};
    d.linearDamping = 2;
    d.angularDamping = 0.5;
    BodyId body = add(world, d);
    run(world, 1, dt);
    EXPECT_NEAR(world.state(body)->linearVelocity.x, 10 * std::exp(-2.0), 1e-5);
    EXPECT_NEAR(world.state(body)->angularVelocity.y, 5 * std::exp(-0.5), 1e-5);
    ASSERT_TRUE(world.setDamping(body, 0, 0).ok());
    Vec3 before = world.state(body)->linearVelocity;
    run(world, 0.5, dt);
    EXPECT_EQ(world.state(body)->linearVelocity, before);
  }
}

TEST(Forces, HugeDampingStopsAndNeverReverses) {
  World world = emptySpace();
  BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {});
  d.linearVelocity = {10, 0, 0};
  d.linearDamping = 1e6;
  BodyId body = add(world, d);
  stepSound(world);
  EXPECT_GE(world.state(body)->linearVelocity.x, 0);
  EXPECT_LT(world.state(body)->linearVelocity.x, 1e-6);
}

TEST(Forces, GravityOnATiltedAxisMovesAlongIt) {
  WorldDef def;
  def.gravity = {3, -4, 1};
  World world = makeWorld(def);
  BodyId body = addBox(world, {0.1, 0.1, 0.1}, {});
  run(world, 1);
  expectNear(world.state(body)->position, {1.5, -2, 0.5}, 1e-9);
}

}  // namespace
}  // namespace brickfall
