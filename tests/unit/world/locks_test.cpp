// Bodies with locked axes, bodies that are switched off and on, and the callback before the solve.
#include <algorithm>

#include "math/random.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

double allOf(const World& world) {
  const Energy energy = world.energy();
  return energy.kinetic + energy.potential;
}

BodyDef lockedBox(Vec3 half, Vec3 position, const AxisLocks& locks) {
  BodyDef def = bodyOf(boxOf(half), position);
  def.locks = locks;
  return def;
}

AxisLocks railAlongX() {
  AxisLocks rail = AxisLocks::noTurns();
  rail.wayY = rail.wayZ = true;
  return rail;
}

// --- Locked axes

// A pile of puppets, pushed out of true from the side: it is hit by a ball that is not one of them.
TEST(AxisLocks, APileStaysInItsPlaneToTheLastBitAndGainsNothing) {
  for (const double dt : {1.0 / 30, 1.0 / 120}) {
    World world = makeWorld();
    addGround(world);
    Random random(5);
    std::vector<std::pair<BodyId, double>> pile;  // with its z
    for (int i = 0; i < 14; i++) {
      BodyDef def =
          lockedBox({.2, .1, .3}, {random.between(-.6, .6), .3 + .5 * i, random.between(-.1, .1)}, AxisLocks::plane());
      def.rotation = turn({0, 0, 1}, random.between(0, 360));
      def.linearVelocity = {random.between(-2, 2), 0, 3};
      def.angularVelocity = {1, 2, random.between(-5, 5)};
      pile.emplace_back(add(world, def), def.position.z);
    }
    BodyDef shot = bodyOf(sphereOf(.3), {0, .8, 5});
    shot.linearVelocity = {1, 1, -20};
    const BodyId ball = add(world, shot);
    const double given = allOf(world);
    double last = given, gained = 0;
    for (double t = 0; t < 2 && !HasFailure(); t += dt) {
      stepSound(world, dt);
      gained += std::max(0.0, allOf(world) - std::exchange(last, allOf(world)));
      for (const auto& [body, z] : pile) {
        const BodyState s = *world.state(body);
        EXPECT_EQ(s.position.z, z);
        EXPECT_EQ(s.linearVelocity.z, 0);
        EXPECT_TRUE(s.rotation.x == 0 && s.rotation.y == 0);
        EXPECT_TRUE(s.angularVelocity.x == 0 && s.angularVelocity.y == 0);
      }
    }
    EXPECT_LT(gained, 1e-3 * given);
    EXPECT_LT(world.state(ball)->linearVelocity.z, 19);
  }
}

// A ball that meets a bead on a rail obliquely: the rail takes what goes across it.
TEST(AxisLocks, ABeadOnARailTakesTheImpulseAlongIt) {
  for (const double dt : {1.0 / 30, 1.0 / 240}) {
    World world = emptySpace();
    BodyDef def = lockedBox({.1, .1, .1}, {}, railAlongX());
    def.shapes[0].material.restitution = 1;
    const BodyId bead = add(world, def);
    def = bodyOf(sphereOf(.1, 1000, 0), {-1, 0, 0});
    def.linearVelocity = {4, 0, 1};  // it meets a face across x
    def.position.z = -.2;
    const BodyId ball = add(world, def);
    const double energy = world.energy().kinetic, momentum = world.linearMomentum().x;
    run(world, 1, dt);
    EXPECT_GT(world.state(bead)->linearVelocity.x, 1);
    EXPECT_EQ(world.state(bead)->position.z, 0);
    EXPECT_EQ(world.state(bead)->position.y, 0);
    EXPECT_NEAR(world.linearMomentum().x, momentum, 1e-5 * momentum);
    EXPECT_NEAR(world.energy().kinetic, energy, 1e-4 * energy);
    EXPECT_NEAR(world.state(ball)->linearVelocity.z, 1, 1e-5);
  }
}

// Slides that no turn slows: v^2 / (2 mu g); and forces along locked axes do nothing.
TEST(AxisLocks, WhatCannotTurnSlidesUpright) {
  World world = makeWorld();
  addGround(world);
  BodyDef def = lockedBox({.1, .4, .1}, {0, .4, 0}, AxisLocks::noTurns());
  def.linearVelocity = {3, 0, 0};
  const BodyId body = add(world, def);
  for (int i = 0; i < 90; i++) {
    ASSERT_TRUE(world.applyTorque(body, {500, 500, 500}).ok());
    stepSound(world);
  }
  EXPECT_NEAR(world.state(body)->position.x, 9 / (2 * .6 * kG), 2e-3);
  EXPECT_TRUE(world.state(body)->rotation == Quat{});
  ASSERT_TRUE(world.applyAngularImpulse(body, {3, 3, 3}).ok());
  EXPECT_TRUE(world.state(body)->angularVelocity == Vec3{});
}

// About two free axes the inertia changes as the body turns: momentum about them stays, energy never grows.
TEST(AxisLocks, OneLockedTurnGainsNothing) {
  World world = emptySpace();
  AxisLocks locks;
  locks.turnX = true;
  BodyDef def = lockedBox({.1, .2, .4}, {}, locks);
  def.angularVelocity = {1, 3, 5};
  const BodyId body = add(world, def);
  double last = world.energy().kinetic;
  const double first = last;
  for (int i = 0; i < 300; i++) {
    stepSound(world);
    EXPECT_LE(world.energy().kinetic, last * (1 + 1e-12));
    last = world.energy().kinetic;
    EXPECT_EQ(world.state(body)->angularVelocity.x, 0);
  }
  EXPECT_GT(last, 0.97 * first);
}

// What its locks hold is as good as fixed: it carries a stack, which sleeps, and takes the blow of a heavy ball. Let go, it falls.
TEST(AxisLocks, AShelfThatIsLockedIsAsGoodAsFixed) {
  Vec3 balls[2];
  for (const bool locked : {false, true}) {
    World world = makeWorld();
    AxisLocks all = railAlongX();
    all.wayX = true;
    BodyDef def = lockedBox({.5, .05, .5}, {0, 2, 0}, all);
    if (!locked) def.type = BodyType::fixed;
    const BodyId shelf = add(world, def);
    std::vector<BodyId> stack;
    for (int i = 0; i < 3; i++) stack.push_back(addBox(world, {.1, .1, .1}, {-.2, 2.15 + .2 * i, 0}));
    run(world, 1);
    EXPECT_NEAR(world.state(stack[2])->position.y, 2.55, 2e-3);
    EXPECT_FALSE(world.state(stack[2])->awake);
    BodyDef shot = bodyOf(sphereOf(.1, 7800), {.3, 4, 0});
    shot.linearVelocity = {0, -30, 0};
    const BodyId ball = add(world, shot);
    run(world, .3);
    balls[locked] = world.state(ball)->position;
    EXPECT_EQ(world.state(shelf)->position, (Vec3{0, 2, 0}));
    EXPECT_TRUE(world.state(shelf)->locks == all);
    if (!locked) continue;
    ASSERT_TRUE(world.setLocks(shelf, {}).ok());
    run(world, .5);
    EXPECT_LT(world.state(shelf)->position.y, 1.5);
  }
  EXPECT_GT(balls[0].y, 2.1);
  expectNear(balls[1], balls[0], 2e-3);
}

// A wall in running bond of bricks that keep to its plane, a box on top that slides along x alone, and three boxes that hang
// beside it on hinges: all rests and sleeps, where it was, and not by one bit beside its plane, whatever threads step it.
TEST(AxisLocks, WhatIsLockedRestsWhereItIs) {
  std::uint64_t hashes[2];
  for (const int threads : {1, 3}) {
    WorldDef of;
    of.threads = threads;
    World world = makeWorld(of);
    addGround(world);
    std::vector<std::pair<BodyId, Vec3>> all;
    const auto anyAwake = [&] {
      return std::any_of(all.begin(), all.end(), [&](const auto& body) { return world.state(body.first)->awake; });
    };
    const auto lay = [&](Vec3 half, Vec3 position, const AxisLocks& locks) {
      all.emplace_back(add(world, lockedBox(half, position, locks)), position);
      return all.back().first;
    };
    for (int course = 0; course < 6; course++)
      for (int i = 0; i < 5 - course % 2; i++)
        lay({.1, .05, .1}, {.21 * i + .105 * (course % 2), .05 + .1 * course, .013 * i}, AxisLocks::plane());
    lay({.2, .05, .1}, {.5, .65, .02}, railAlongX());
    BodyId last = add(world, bodyOf(boxOf({.05, .05, .05}), {2, 2.1, .3}, BodyType::fixed));
    std::vector<JointId> hinges;
    for (int i = 0; i < 3; i++) {
      JointDef hinge;
      hinge.type = JointType::revolute;
      hinge.axis = {0, 0, 1};
      hinge.anchor = {2, 2 - .3 * i, .3};
      hinge.bodyA = last;
      hinge.bodyB = last = lay({.05, .15, .05}, {2, 1.85 - .3 * i, .3}, AxisLocks::plane());
      hinges.push_back(*world.createJoint(hinge));
    }
    ASSERT_TRUE(world.applyImpulse(last, {.05, 0, 3}).ok());
    for (int i = 0; i < 5 * 60 && anyAwake(); i++) {
      stepSound(world);
      for (const auto& [body, place] : all) {
        const BodyState s = *world.state(body);
        ASSERT_EQ(s.position.z, place.z);
        ASSERT_TRUE(s.linearVelocity.z == 0 && s.angularVelocity.x == 0 && s.angularVelocity.y == 0);
        ASSERT_TRUE(s.rotation.x == 0 && s.rotation.y == 0);
      }
    }
    EXPECT_FALSE(anyAwake());
    for (const auto& [body, place] : all) expectNear(world.state(body)->position, place, 2e-3);
    for (JointId hinge : hinges) EXPECT_LT(world.state(hinge)->error, 1e-5);
    EXPECT_TRUE(world.state(all[27].first)->rotation == Quat{});
    hashes[threads > 1] = world.stateHash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// --- Switched off and on

TEST(Enabled, WhatIsOffTakesNoPart) {
  World world = makeWorld();
  const BodyId ground = addGround(world), low = addBox(world, {.2, .1, .2}, {0, .1, 0});
  const BodyId high = addBox(world, {.2, .1, .2}, {0, .3, 0}), hung = addBox(world, {.1, .1, .1}, {0, .6, 0});
  JointDef rope;
  rope.type = JointType::fixed;
  rope.bodyA = high;
  rope.bodyB = hung;
  rope.anchor = {0, .5, 0};
  const JointId joint = *world.createJoint(rope);
  run(world, 1);
  ASSERT_TRUE(world.setEnabled(low, false).ok());
  EXPECT_FALSE(world.state(low)->enabled);
  EXPECT_FALSE(world.castRay({0, .1, 5}, {0, 0, -1}, 10)->has_value());
  EXPECT_EQ(world.applyForce(low, {1, 0, 0}).error().code, ErrorCode::wrongState);
  ASSERT_TRUE(world.setLinearVelocity(low, {0, 0, 1}).ok());
  stepSound(world);
  EXPECT_EQ(std::count_if(world.events().end.begin(), world.events().end.end(),
                          [&](const ContactEvent& e) { return e.bodyB == low || e.bodyA == low; }),
            2);
  run(world, 1);  // the other two fall to the ground, through it
  EXPECT_NEAR(world.state(high)->position.y, .1, 2e-3);
  EXPECT_NEAR(world.state(low)->position.y, .1, 1e-4);
  EXPECT_NEAR(world.state(low)->position.z, 0, 1e-4);
  // A joint holds nothing while one of its bodies is off, and holds again.
  ASSERT_TRUE(world.setEnabled(high, false).ok());
  ASSERT_TRUE(world.setTransform(low, {3, .1, 0}, {}).ok());
  ASSERT_TRUE(world.setEnabled(low, true).ok());
  run(world, 1);
  EXPECT_TRUE(world.isValid(joint));
  EXPECT_NEAR(world.state(hung)->position.y, .1, 2e-3);
  EXPECT_GT(world.state(low)->position.z, .05);
  ASSERT_TRUE(world.setTransform(high, {0, 1.1, 0}, {}).ok());
  ASSERT_TRUE(world.setTransform(hung, {0, 1.4, 0}, {}).ok());
  ASSERT_TRUE(world.setEnabled(high, true).ok());
  run(world, 1.5);
  EXPECT_NEAR(world.state(hung)->position.y - world.state(high)->position.y, .3, 2e-3);
  // A ground that is off lets all fall.
  ASSERT_TRUE(world.setEnabled(ground, false).ok());
  run(world, 1);
  EXPECT_LT(world.state(hung)->position.y, -1);
  EXPECT_LT(world.state(low)->position.y, -1);
}

// It has a number that no list of the islands knew.
TEST(Enabled, ABodyMadeSwitchedOffLeavesTheIslandsWhole) {
  World world = makeWorld();
  addGround(world);
  addBox(world, {.1, .1, .1}, {0, .1, 0});
  run(world, .2);
  BodyDef def = bodyOf(boxOf({.1, .1, .1}), {0, .3, 0});
  def.enabled = false;
  const BodyId made = add(world, def);
  stepSound(world);
  ASSERT_TRUE(world.setEnabled(made, true).ok());
  run(world, .2);
  EXPECT_NEAR(world.state(made)->position.y, .3, 2e-3);
}

// --- Before the solve

TEST(PreSolve, ChangesContactsForTheStepInAFixedOrder) {
  World world = makeWorld();
  const BodyId ground = addGround(world);
  BodyDef def = bodyOf(boxOf({.1, .1, .1}), {0, .1, 0});
  def.linearVelocity = {3, 0, 0};
  const BodyId onIce = add(world, def);
  def.position.z = 2;
  const BodyId rough = add(world, def);
  const BodyId ball = add(world, bodyOf(sphereOf(.1), {0, 1.1, -2})), ghost = addBox(world, {.1, .1, .1}, {0, .1, 4});
  std::vector<std::pair<ShapeId, ShapeId>> asked;
  ASSERT_TRUE(world
                  .setPreSolve([&](PreSolveContact& contact) {
                    asked.emplace_back(contact.shapeA, contact.shapeB);
                    EXPECT_EQ(contact.bodyA, ground);
                    EXPECT_NEAR(contact.normalWorld.y, 1, 1e-9);
                    EXPECT_NEAR(contact.friction, .6, 1e-6);
                    EXPECT_EQ(world.setGravity({}).error().code, ErrorCode::wrongState);
                    if (contact.bodyB == onIce) contact.friction = 0;
                    if (contact.bodyB == ball) contact.restitution = .5;
                    if (contact.bodyB == rough) contact.restitution = std::nan("");
                    if (contact.bodyB == ghost) contact.enabled = false;
                  })
                  .ok());
  double highest = 0;
  for (int i = 0; i < 60; i++) {
    asked.clear();
    stepSound(world);
    EXPECT_TRUE(std::is_sorted(asked.begin(), asked.end()));
    if (world.time() > .55) highest = std::max(highest, world.state(ball)->position.y);
    if (i != 30) continue;
    World other = makeWorld();  // without the callback the next step differs, with it it does not
    ASSERT_TRUE(other.restore(world.snapshot()).ok());
    ASSERT_TRUE(world.restore(world.snapshot()).ok());
  }
  EXPECT_NEAR(world.state(onIce)->linearVelocity.x, 3, 1e-4);
  EXPECT_NEAR(world.state(rough)->position.x, 9 / (2 * .6 * kG), 5e-3);
  EXPECT_NEAR(highest, .1 + .25, .03);
  EXPECT_LT(world.state(ghost)->position.y, -3);
  // Without it, the materials count again.
  ASSERT_TRUE(world.setPreSolve({}).ok());
  run(world, 1);
  EXPECT_NEAR(world.state(onIce)->linearVelocity.x, 0, 1e-9);
}

// A platform that is solid from above alone, also for what is fast and for what sleeps on it.
TEST(PreSolve, MakesAPlatformThatIsSolidFromAbove) {
  World world = makeWorld();
  BodyDef def = bodyOf(boxOf({1, .05, 1}), {0, 2, 0}, BodyType::fixed);
  const BodyId platform = add(world, def);
  ASSERT_TRUE(world
                  .setPreSolve([&](PreSolveContact& contact) {
                    const bool first = contact.bodyA == platform;
                    if (!first && contact.bodyB != platform) return;
                    const double rises = contact.velocityWorld.y * (first ? 1 : -1);
                    const Vec3 up = contact.normalWorld * (first ? 1.0 : -1.0);
                    contact.enabled = !(rises > 0) && up.y > .5;
                  })
                  .ok());
  const BodyId jumper = addBox(world, {.1, .1, .1}, {0, 1, 0}, {0, 6, 0});
  const BodyId fast = addBox(world, {.1, .1, .1}, {.6, 1, 0}, {0, 60, 0});
  run(world, 3);
  EXPECT_NEAR(world.state(jumper)->position.y, 2.15, 2e-3);
  EXPECT_FALSE(world.state(jumper)->awake);
  EXPECT_GT(world.state(fast)->position.y, 20);
}

TEST(ContactEvents, NameTheShapesThatTouch) {
  World world = makeWorld();
  const BodyId ground = addGround(world);
  BodyDef def = bodyOf(boxOf({.3, .05, .1}), {0, .35, 0});
  for (const double x : {-.25, .25}) {
    ShapeDef foot = boxOf({.05, .05, .05});
    foot.local.position = {x, -.1, 0};
    def.shapes.push_back(foot);
  }
  const BodyId table = add(world, def);
  std::vector<ShapeId> begun, ended;
  for (int i = 0; i < 60; i++) {
    stepSound(world);
    for (const ContactEvent& event : world.events().begin) {
      EXPECT_EQ(event.shapeA, world.shapes(ground)[0]);
      begun.push_back(event.shapeB);
    }
  }
  std::sort(begun.begin(), begun.end());
  begun.erase(std::unique(begun.begin(), begun.end()), begun.end());
  EXPECT_EQ(begun, (std::vector<ShapeId>{world.shapes(table)[1], world.shapes(table)[2]}));
  ASSERT_TRUE(world.setTransform(table, {0, 3, 0}, {}).ok());
  stepSound(world);
  for (const ContactEvent& event : world.events().end) ended.push_back(event.shapeB);
  std::sort(ended.begin(), ended.end());
  EXPECT_EQ(ended, begun);
}

}  // namespace
}  // namespace brickfall
