// Kinematic bodies: they move as told, whatever they hit, and carry, push and lift what is dynamic.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

BodyId addKinematic(World& world, Vec3 half, Vec3 position, Vec3 velocity = {}, Vec3 spin = {}) {
  BodyDef d = bodyOf(boxOf(half), position, BodyType::kinematic);
  d.linearVelocity = velocity;
  d.angularVelocity = spin;
  return add(world, d);
}

TEST(Kinematic, MovesExactlyAsToldThroughAnything) {
  World world = makeWorld();
  addGround(world);
  BodyId mover = addKinematic(world, {0.5, 0.5, 0.5}, {-3, 0.6, 0}, {2, 0, 0}, {0, 1, 0});
  addBox(world, {0.5, 0.5, 0.5}, {0, 0.5, 0});
  run(world, 1.5);
  BodyState s = *world.state(mover);
  expectNear(s.position, {0, 0.6, 0}, 1e-9);
  expectNear(rotationVector(s.rotation), {0, 1.5, 0}, 1e-9);
  EXPECT_EQ(s.linearVelocity, (Vec3{2, 0, 0}));
}

TEST(Kinematic, PlatformCarriesABoxByFriction) {
  World world = makeWorld();
  BodyId platform = addKinematic(world, {2, 0.1, 2}, {0, 0.1, 0});
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.4, 0});
  run(world, 1);
  for (int i = 0; i < 60; i++) {  // 2 m/s2, less than mu g
    ASSERT_TRUE(world.setLinearVelocity(platform, {2 * (i + 1) * kDt, 0, 0}).ok());
    stepSound(world);
  }
  run(world, 1);
  double moved = world.state(platform)->position.x;
  EXPECT_GT(moved, 2.9);
  EXPECT_NEAR(world.state(box)->position.x, moved, 0.02);
  EXPECT_NEAR(world.state(box)->linearVelocity.x, 2, 1e-3);
}

TEST(Kinematic, PlatformThatPullsAwayTooFastLeavesTheBoxBehind) {
  World world = makeWorld();
  BodyId platform = addKinematic(world, {20, 0.1, 2}, {0, 0.1, 0});
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.4, 0});
  run(world, 0.5);
  ASSERT_TRUE(world.setLinearVelocity(platform, {5, 0, 0}).ok());
  run(world, 0.5);
  // accelerates at mu g until it has caught up
  EXPECT_NEAR(world.state(box)->linearVelocity.x, 0.6 * kG * 0.5, 0.05);
}

TEST(Kinematic, LiftRaisesAStackWithoutSqueezingIt) {
  World world = makeWorld();
  BodyId lift = addKinematic(world, {1, 0.1, 1}, {0, 0.1, 0});
  std::vector<BodyId> stack;
  for (int i = 0; i < 5; i++) stack.push_back(addBox(world, {0.2, 0.1, 0.2}, {0, 0.3 + 0.2 * i, 0}));
  run(world, 0.5);
  ASSERT_TRUE(world.setLinearVelocity(lift, {0, 0.5, 0}).ok());
  run(world, 2);
  for (int i = 0; i < 5; i++) EXPECT_NEAR(world.state(stack[std::size_t(i)])->position.y, 1.3 + 0.2 * i, 0.01) << i;
  ASSERT_TRUE(world.setLinearVelocity(lift, {}).ok());
  run(world, 2);
  for (int i = 0; i < 5; i++) {
    EXPECT_NEAR(world.state(stack[std::size_t(i)])->position.y, 1.3 + 0.2 * i, 0.01) << i;
    EXPECT_FALSE(world.state(stack[std::size_t(i)])->awake) << "a lift that stopped keeps nobody awake";
  }
}

TEST(Kinematic, PushesABoxAlongTheGround) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  BodyId pusher = addKinematic(world, {0.1, 0.2, 0.5}, {-1, 0.25, 0}, {1, 0, 0});
  run(world, 2);
  double front = world.state(pusher)->position.x + 0.1;
  EXPECT_NEAR(world.state(box)->position.x - 0.2, front, 0.01);
  EXPECT_NEAR(world.state(box)->position.y, 0.2, 5e-3);
}

TEST(Kinematic, WakesASleepingBoxThatItReaches) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  run(world, 1);
  ASSERT_FALSE(world.state(box)->awake);
  addKinematic(world, {0.1, 0.2, 0.5}, {-1, 0.25, 0}, {2, 0, 0});
  run(world, 1);
  EXPECT_GT(world.state(box)->position.x, 0.5);
}

TEST(Kinematic, SleepingBoxOnAPlatformWakesWhenThePlatformStarts) {
  World world = makeWorld();
  BodyId platform = addKinematic(world, {2, 0.1, 2}, {0, 0.1, 0});
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.4, 0});
  run(world, 1.5);
  ASSERT_FALSE(world.state(box)->awake);
  ASSERT_TRUE(world.setLinearVelocity(platform, {0.5, 0, 0}).ok());
  run(world, 1);
  EXPECT_NEAR(world.state(box)->position.x, 0.5, 0.05);
  EXPECT_TRUE(world.state(box)->awake) << "what stands on something that moves does not sleep";
}

TEST(Kinematic, TurntableTurnsWhatStandsOnIt) {
  World world = makeWorld();
  addKinematic(world, {2, 0.1, 2}, {0, 0.1, 0}, {}, {0, 0.5, 0});
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0.5, 0.4, 0});
  run(world, 2);
  BodyState s = *world.state(box);
  double angle = std::atan2(-s.position.z, s.position.x);
  EXPECT_NEAR(angle, 1.0, 0.1);
  EXPECT_NEAR(std::hypot(s.position.x, s.position.z), 0.5, 0.03);
}

TEST(Kinematic, TwoKinematicBodiesIgnoreEachOther) {
  World world = makeWorld();
  BodyId a = addKinematic(world, {0.5, 0.5, 0.5}, {-1, 0, 0}, {1, 0, 0});
  BodyId b = addKinematic(world, {0.5, 0.5, 0.5}, {1, 0, 0}, {-1, 0, 0});
  run(world, 2);
  EXPECT_NEAR(world.state(a)->position.x, 1, 1e-9);
  EXPECT_NEAR(world.state(b)->position.x, -1, 1e-9);
}

TEST(Kinematic, ASurfaceThatRunsIsReadAndEndsWithTheBody) {
  World world = makeWorld();
  BodyDef belt = bodyOf(boxOf({2, 0.1, 2}), {0, 0.1, 0}, BodyType::kinematic);
  belt.surfaceVelocity = {0.5, 0, 0};
  const BodyId body = add(world, belt);
  const BodyId box = addBox(world, {0.1, 0.1, 0.1}, {0, 0.3, 0});
  EXPECT_EQ(world.state(body)->surfaceVelocity, (Vec3{0.5, 0, 0}));
  EXPECT_EQ(world.setSurfaceVelocity(box, {1, 0, 0}).error().code, ErrorCode::wrongState);
  run(world, 1);
  EXPECT_NEAR(world.state(box)->linearVelocity.x, 0.5, 1e-5);
  EXPECT_EQ(world.state(body)->position, (Vec3{0, 0.1, 0})) << "the belt itself stays";
  // It goes on, turned with the body, and is added to the body's own motion.
  ASSERT_TRUE(world.setLinearVelocity(body, {0, 0, 0.25}).ok());
  run(world, 1);
  expectNear(world.state(box)->linearVelocity, {0.5, 0, 0.25}, 1e-4);
  ASSERT_TRUE(world.setType(body, BodyType::fixed).ok());
  EXPECT_EQ(world.state(body)->surfaceVelocity, (Vec3{0.5, 0, 0}));
  ASSERT_TRUE(world.setType(body, BodyType::dynamic).ok());
  EXPECT_EQ(world.state(body)->surfaceVelocity, Vec3{});
  stepSound(world);
}

}  // namespace
}  // namespace brickfall
