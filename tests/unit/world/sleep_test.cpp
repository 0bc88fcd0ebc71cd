// Sleep: what rests costs nothing, what is touched wakes, and nothing else does.
#include "support/lab_measure.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

bool allAsleep(const World& world, const std::vector<BodyId>& bodies) {
  for (BodyId body : bodies)
    if (world.state(body)->awake) return false;
  return true;
}

TEST(Sleep, AWallFallsAsleepAndCostsNothing) {
  lab::Options o;
  o.sleep = true;
  lab::Scene s = lab::make("w10", o);
  run(s.world, 1.5);
  ASSERT_TRUE(allAsleep(s.world, s.boxes));
  std::uint64_t before = s.world.stateHash();
  StepReport report = stepSound(s.world);
  EXPECT_EQ(report.awakeBodies, 0);
  EXPECT_EQ(report.manifolds, 0);
  EXPECT_EQ(report.islands, 0);
  EXPECT_EQ(report.solveVisits, 0);
  EXPECT_EQ(report.lightVisits, 0);
  EXPECT_EQ(report.manifoldsComputed, 0);
  EXPECT_EQ(s.world.stateHash(), before);
}

TEST(Sleep, ABallWakesTheWall) {
  lab::Options o;
  o.sleep = true;
  lab::Scene s = lab::make("w10", o);
  run(s.world, 1.5);
  ASSERT_TRUE(allAsleep(s.world, s.boxes));
  BodyDef ball = bodyOf(sphereOf(0.1, 7800), {1, 0.35, 1});
  ball.linearVelocity = {0, 0, -10};
  add(s.world, ball);
  stepSound(s.world);
  EXPECT_TRUE(allAsleep(s.world, s.boxes)) << "it has not arrived yet";
  run(s.world, 0.25);
  EXPECT_FALSE(allAsleep(s.world, s.boxes));
  double moved = 0;
  for (std::size_t i = 0; i < s.boxes.size(); i++) moved = std::max(moved, lab::boxMove(s, i));
  EXPECT_GT(moved, 0.02);
}

TEST(Sleep, AFarIslandStaysAsleep) {
  World world = makeWorld();
  addGround(world);
  std::vector<BodyId> far, near;
  for (int i = 0; i < 4; i++) {
    far.push_back(addBox(world, {0.2, 0.1, 0.2}, {5, 0.1 + 0.2 * i, 0}));
    near.push_back(addBox(world, {0.2, 0.1, 0.2}, {0, 0.1 + 0.2 * i, 0}));
  }
  run(world, 1.5);
  ASSERT_TRUE(allAsleep(world, far) && allAsleep(world, near));
  BodyDef ball = bodyOf(sphereOf(0.1, 7800), {0, 0.5, 1});
  ball.linearVelocity = {0, 0, -10};
  add(world, ball);
  for (int i = 0; i < 120; i++) {
    stepSound(world);
    ASSERT_TRUE(allAsleep(world, far)) << "step " << i;
    EXPECT_TRUE(world.events().woke.empty() || i < 30);
  }
  EXPECT_GT(length(world.state(near[2])->position - Vec3{0, 0.5, 0}), 0.1) << "it was hit";
}

TEST(Sleep, DestroyingTheGroundWakesWhatStoodOnIt) {
  World world = makeWorld();
  BodyId ground = add(world, bodyOf(boxOf({2, 0.1, 2}), {0, -0.1, 0}, BodyType::fixed));
  BodyId otherGround = add(world, bodyOf(boxOf({2, 0.1, 2}), {10, -0.1, 0}, BodyType::fixed));
  std::vector<BodyId> stack, other;
  for (int i = 0; i < 3; i++) {
    stack.push_back(addBox(world, {0.2, 0.1, 0.2}, {0, 0.1 + 0.2 * i, 0}));
    other.push_back(addBox(world, {0.2, 0.1, 0.2}, {10, 0.1 + 0.2 * i, 0}));
  }
  run(world, 1.5);
  ASSERT_TRUE(allAsleep(world, stack) && allAsleep(world, other));
  ASSERT_TRUE(world.destroyBody(ground).ok());
  expectSound(world);
  run(world, 0.5);
  for (int i = 0; i < 3; i++)
    EXPECT_NEAR(world.state(stack[std::size_t(i)])->position.y, 0.1 + 0.2 * i - kG * 0.125, 0.01);
  EXPECT_TRUE(allAsleep(world, other));
  EXPECT_TRUE(world.isValid(otherGround));
}

TEST(Sleep, DestroyingASleepingBrickWakesItsNeighbours) {
  World world = makeWorld();
  addGround(world);
  std::vector<BodyId> stack;
  for (int i = 0; i < 3; i++) stack.push_back(addBox(world, {0.2, 0.1, 0.2}, {0, 0.1 + 0.2 * i, 0}));
  run(world, 1.5);
  ASSERT_TRUE(allAsleep(world, stack));
  ASSERT_TRUE(world.destroyBody(stack[1]).ok());
  run(world, 1);
  EXPECT_NEAR(world.state(stack[2])->position.y, 0.3, 5e-3);
}

TEST(Sleep, EverySetterWakes) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  auto asleep = [&] {
    run(world, 1.5);
    ASSERT_FALSE(world.state(box)->awake);
  };
  using Call = std::function<Status()>;
  for (const Call& call :
       {Call([&] { return world.wake(box); }), Call([&] {
          return world.applyForce(box, {1, 0, 0});
        }),
        Call([&] {
          return world.applyForceAtPoint(box, {1, 0, 0}, {0, 0, 0});
        }),
        Call([&] {
          return world.applyTorque(box, {1, 0, 0});
        }),
        Call([&] {
          return world.applyImpulse(box, {1, 0, 0});
        }),
        Call([&] {
          return world.applyImpulseAtPoint(box, {1, 0, 0}, {0, 0, 0});
        }),
        Call([&] {
          return world.applyAngularImpulse(box, {1, 0, 0});
        }),
        Call([&] {
          return world.setLinearVelocity(box, {0.1, 0, 0});
        }),
        Call([&] {
          return world.setAngularVelocity(box, {0.1, 0, 0});
        }),
        Call([&] { return world.setGravityScale(box, 0.9); }), Call([&] { return world.setDamping(box, 0.1, 0.1); }),
        Call([&] { return world.setDragArea(box, 0.1); }), Call([&] {
          return world.setTransform(box, {0, 0.2, 0}, {});
        }),
        Call([&] {
          return world.setGravity({0, -9.7, 0});
        })}) {
    asleep();
    ASSERT_TRUE(call().ok());
    EXPECT_TRUE(world.state(box)->awake);
    expectSound(world);
  }
}

TEST(Sleep, ABodyThatMayNotSleepKeepsItsIslandAwake) {
  World world = makeWorld();
  addGround(world);
  BodyId lower = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  BodyDef d = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 0.5, 0});
  d.allowSleep = false;
  BodyId upper = add(world, d);
  BodyId alone = addBox(world, {0.2, 0.2, 0.2}, {3, 0.2, 0});
  run(world, 2);
  EXPECT_TRUE(world.state(lower)->awake);
  EXPECT_TRUE(world.state(upper)->awake);
  EXPECT_FALSE(world.state(alone)->awake);
}

TEST(Sleep, OffMeansOff) {
  World world = awakeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  run(world, 3);
  EXPECT_TRUE(world.state(box)->awake);
}

TEST(Sleep, DelayIsKept) {
  for (double delay : {0.1, 1.0}) {
    WorldDef def;
    def.sleepDelay = delay;
    World world = makeWorld(def);
    addGround(world);
    BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
    double slept = -1;
    for (int i = 0; i < 180 && slept < 0; i++) {
      stepSound(world);
      if (!world.state(box)->awake) slept = world.time();
    }
    EXPECT_GE(slept, delay - 1e-9);
    EXPECT_LE(slept, delay + 0.3);
  }
}

TEST(Sleep, WokenForNothingItStaysWhereItIs) {
  lab::Options o;
  o.sleep = true;
  lab::Scene s = lab::make("w10", o);
  run(s.world, 1.5);
  std::vector<Vec3> at;
  for (BodyId body : s.boxes) at.push_back(s.world.state(body)->position);
  for (int i = 0; i < 3; i++) {
    ASSERT_TRUE(s.world.wake(s.boxes[50]).ok());
    run(s.world, 1);
  }
  for (std::size_t i = 0; i < at.size(); i++) expectNear(s.world.state(s.boxes[i])->position, at[i], 1e-5);
  EXPECT_TRUE(allAsleep(s.world, s.boxes));
}

// Destroying bodies elsewhere in every step must not keep the rest awake.
TEST(Sleep, DebrisRemovalElsewhereKeepsNobodyAwake) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  for (int i = 0; i < 90; i++) {
    BodyId debris = addBox(world, {0.05, 0.05, 0.05}, {5, 0.05, 0});
    stepSound(world);
    ASSERT_TRUE(world.destroyBody(debris).ok());
    expectSound(world);
  }
  EXPECT_FALSE(world.state(box)->awake);
}

// A kinematic body beside a sleeping one, while another island falls asleep.
TEST(Sleep, AMovingKinematicBodyIsNotForgottenWhenOthersFallAsleep) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  run(world, 1);
  ASSERT_FALSE(world.state(box)->awake);
  BodyDef wall = bodyOf(boxOf({0.1, 0.5, 0.5}), {-0.325, 0.6, 0}, BodyType::kinematic);
  wall.linearVelocity = {1e-4, 0, 0};  // near enough for a pair, too far for a contact
  BodyId pusher = add(world, wall);
  BodyId late = addBox(world, {0.2, 0.2, 0.2}, {5, 0.2, 0});
  for (int i = 0; i < 90 && world.state(late)->awake; i++) stepSound(world);
  ASSERT_FALSE(world.state(late)->awake);
  ASSERT_TRUE(world.setLinearVelocity(pusher, {0.2, 0, 0}).ok());
  run(world, 1.5);
  EXPECT_GT(world.state(box)->position.x, 0.15);
}

// The same, with a speed that never changes: the pair must not be put away with the sleepers.
TEST(Sleep, ASlowlyApproachingKinematicBodyIsNotForgottenEither) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  run(world, 1);
  ASSERT_FALSE(world.state(box)->awake);
  BodyDef wall = bodyOf(boxOf({0.1, 0.5, 0.5}), {-0.34, 0.6, 0}, BodyType::kinematic);
  wall.linearVelocity = {0.01, 0, 0};
  add(world, wall);
  addBox(world, {0.2, 0.2, 0.2}, {5, 0.2, 0});
  run(world, 12);
  EXPECT_GT(world.state(box)->position.x, 0.05);
}

TEST(Sleep, AFixedBodyCreatedInsideASleepingOnePushesItOut) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  run(world, 1);
  ASSERT_FALSE(world.state(box)->awake);
  add(world, bodyOf(boxOf({0.2, 0.2, 0.2}), {0.395, 0.2, 0}, BodyType::fixed));
  run(world, 1);
  int contacts = 0;
  world.forEachContact([&](const ContactView& c) { contacts += c.bodyA != world.bodies()[0]; });
  EXPECT_GE(contacts, 1) << "the two overlap and have no contact";
}

}  // namespace
}  // namespace brickfall
