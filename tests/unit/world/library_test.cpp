// Calls of a program that has a world of its own: sensors, whole shapes as questions, masses of its own, its own filter,
// threads and memory.
#include <algorithm>
#include <thread>
#include <unordered_set>

#include "counting_memory.h"
#include "math/random.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

BodyDef sensorBox(Vec3 half, Vec3 position) {
  BodyDef def = bodyOf(boxOf(half), position, BodyType::fixed);
  def.shapes[0].sensor = true;
  return def;
}

TEST(MakeBody, GivesTheUsualBodies) {
  World world = makeWorld();
  const Material brick{.density = 1900};
  const BodyId ground = add(world, groundPlane(0.5));
  const BodyId box = add(world, boxBody({0.2, 0.1, 0.1}, brick, {0, 0.6, 0}));
  const BodyId ball = add(world, ballBody(0.1, brick, {1, 0.7, 0}));
  EXPECT_NEAR(world.massProperties(box)->mass, 1900 * 0.002, 1e-9);
  EXPECT_NEAR(world.massProperties(ball)->mass, 1900 * 4.0 / 3 * kPi * 1e-3, 1e-6);
  EXPECT_EQ(world.state(ground)->type, BodyType::fixed);
  run(world, 1);
  EXPECT_NEAR(world.state(box)->position.y, 0.55, 1e-3);
  EXPECT_NEAR(world.state(ball)->position.y, 0.6, 1e-3);
}

TEST(Ids, AreKeysOfUnorderedContainers) {
  std::unordered_set<BodyId> bodies;
  std::unordered_set<std::size_t> hashes;
  for (std::uint32_t i = 1; i <= 1000; i++)
    for (std::uint16_t generation : {1, 2}) {
      bodies.insert({i, generation, 1});
      hashes.insert(std::hash<BodyId>()({i, generation, 1}));
    }
  EXPECT_EQ(bodies.size(), 2000u);
  EXPECT_EQ(hashes.size(), 2000u);
}

// --- Sensors

TEST(Sensors, TellWhoComesAndWhoLeavesAndHoldNobody) {
  World world = makeWorld();
  addGround(world);
  const BodyId gate = add(world, sensorBox({0.5, 0.5, 0.5}, {0, 2, 0}));
  const BodyId box = addBox(world, {0.1, 0.1, 0.1}, {0, 3.5, 0});
  int begun = 0, ended = 0, hits = 0;
  for (int i = 0; i < 120; i++) {
    stepSound(world);
    for (const SensorEvent& event : world.events().sensorBegin) {
      EXPECT_EQ(event.sensorBody, gate);
      EXPECT_EQ(event.body, box);
      EXPECT_EQ(event.sensor, world.shapes(gate)[0]);
      EXPECT_EQ(event.shape, world.shapes(box)[0]);
      EXPECT_LT(world.state(box)->position.y, 2.6 + 0.2);
      begun++;
    }
    ended += int(world.events().sensorEnd.size());
    for (const HitEvent& hit : world.events().hits) hits += hit.bodyA == gate || hit.bodyB == gate;
  }
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(hits, 0);
  EXPECT_NEAR(world.state(box)->position.y, 0.1, 2e-3);
}

TEST(Sensors, AreNeitherHitNorWeighedNorFound) {
  World world = makeWorld();
  addGround(world);
  add(world, sensorBox({1, 1, 1}, {0, 2, 0}));
  EXPECT_FALSE(world.castRay({0, 2, 5}, {0, 0, -1}, 10)->has_value());
  EXPECT_TRUE(world.castRayAll({0, 2, 5}, {0, 0, -1}, 10)->empty());
  EXPECT_TRUE(world.overlapSphere({0, 2, 0}, 0.5)->empty());
  EXPECT_TRUE(world.overlapShape(boxOf({1, 1, 1}), {{0, 2, 0}, {}})->empty());
  BodyDef scout = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 5, 0});
  ShapeDef far = sphereOf(2);
  far.local.position = {1, 0, 0};
  far.sensor = true;
  scout.shapes.push_back(far);
  const BodyId body = add(world, scout);
  EXPECT_NEAR(world.massProperties(body)->mass, 8, 1e-9);
  EXPECT_EQ(world.massProperties(body)->centre.x, 0);
  BodyDef none = sensorBox({1, 1, 1}, {});
  none.type = BodyType::dynamic;
  EXPECT_FALSE(world.createBody(none).ok());
}

TEST(Sensors, GoOnInARestoredWorldAndEndWithTheirBodies) {
  World world = emptySpace();
  const BodyId gate = add(world, sensorBox({1, 1, 1}, {}));
  const BodyId box = addBox(world, {0.1, 0.1, 0.1}, {});
  stepSound(world);
  EXPECT_EQ(world.events().sensorBegin.size(), 1u);
  World other = emptySpace();
  ASSERT_TRUE(other.restore(world.snapshot()).ok());
  stepSound(other);
  EXPECT_TRUE(other.events().sensorBegin.empty());
  const ShapeId shape = world.shapes(box)[0];
  ASSERT_TRUE(world.destroyBody(box).ok());
  stepSound(world);
  ASSERT_EQ(world.events().sensorEnd.size(), 1u);
  EXPECT_EQ(world.events().sensorEnd[0].shape, shape);
  ASSERT_TRUE(other.destroyBody(other.bodies()[0]).ok());
  stepSound(other);
  EXPECT_EQ(other.events().sensorEnd.size(), 1u);
  EXPECT_TRUE(world.isValid(gate));
}

// --- Questions with rays and shapes

TEST(ShapeQueries, ARayTellsAllThatItMeets) {
  World world = emptySpace();
  std::vector<BodyId> boxes;
  for (int i = 0; i < 5; i++) boxes.push_back(addBox(world, {0.5, 0.5, 0.5}, {0, 0, -2.0 * i}));
  const auto hits = world.castRayAll({0, 0, 3}, {0, 0, -2}, 9);
  ASSERT_TRUE(hits.ok());
  ASSERT_EQ(hits->size(), 4u);  // the fifth begins at 10.5 m
  for (std::size_t i = 0; i < hits->size(); i++) {
    EXPECT_EQ((*hits)[i].body, boxes[i]);
    EXPECT_NEAR((*hits)[i].distance, 2.5 + 2.0 * double(i), 1e-9);
    expectNear((*hits)[i].normalWorld, {0, 0, 1}, 1e-9);
  }
  EXPECT_EQ((*hits)[0].shape, world.castRay({0, 0, 3}, {0, 0, -2}, 8).value()->shape);
}

TEST(ShapeQueries, ACastStopsWhereTheShapesMeet) {
  World world = emptySpace();
  const BodyId wall = addBox(world, {1, 1, 0.1}, {0, 0, 0});
  addBox(world, {1, 1, 0.1}, {0, 0, -2});
  const ShapeDef ball = sphereOf(0.5);
  const auto hit = world.castShape(ball, {{0.2, 0, 3}, {}}, {0, 0, -10});
  ASSERT_TRUE(hit.ok() && hit->has_value());
  EXPECT_EQ((*hit)->body, wall);
  EXPECT_NEAR((*hit)->share, (3 - 0.6) / 10, 1e-6);
  expectNear((*hit)->normalWorld, {0, 0, 1}, 1e-6);
  expectNear((*hit)->pointWorld, {0.2, 0, 0.1}, 1e-5);
  EXPECT_FALSE(world.castShape(ball, {{0.2, 0, 3}, {}}, {0, 0, -1})->has_value());
  EXPECT_FALSE(world.castShape(ball, {{0.2, 3, 3}, {}}, {0, 0, -10})->has_value());
  const auto within = world.castShape(ball, {{0, 0, 0.3}, {}}, {0, 0, 5});
  ASSERT_TRUE(within.ok() && within->has_value());
  EXPECT_EQ((*within)->share, 0);
  EXPECT_EQ((*within)->normalWorld, Vec3{});
}

// A cast agrees with overlaps along its way: none before it stops, one right behind.
TEST(ShapeQueries, CastsAndOverlapsAgree) {
  World world = emptySpace();
  Random random(3);
  for (int i = 0; i < 30; i++) {
    ShapeDef shapes[] = {boxOf({.2, .1, .3}), sphereOf(.2), capsuleOf(.1, .2), hullOf(.3), cylinderOf(.2, .2)};
    BodyDef def =
        bodyOf(shapes[random.below(5)], {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)});
    def.rotation = turn({random.between(-1, 1), 1, random.between(-1, 1)}, random.between(0, 360));
    add(world, def);
  }
  int met = 0;
  for (int i = 0; i < 60; i++) {
    ShapeDef shapes[] = {boxOf({.1, .1, .2}), sphereOf(.15), capsuleOf(.1, .1), hullOf(.2)};
    const ShapeDef& shape = shapes[random.below(4)];
    const Transform from{{-4, random.between(-2, 2), random.between(-2, 2)}, turn({0, 1, 1}, random.between(0, 360))};
    const Vec3 motion{8, random.between(-1, 1), 0};
    const auto hit = world.castShape(shape, from, motion);
    ASSERT_TRUE(hit.ok());
    const auto overlapsAt = [&](double share) {
      return !world.overlapShape(shape, {from.position + motion * share, from.rotation})->empty();
    };
    const double end = *hit ? (*hit)->share : 1;
    for (int k = 0; k < 20; k++) EXPECT_FALSE(overlapsAt(end * k / 20)) << "cast " << i;
    if (!*hit) continue;
    met++;
    EXPECT_NEAR(length((*hit)->normalWorld), 1, 1e-9);
    EXPECT_LT(dot((*hit)->normalWorld, motion), 0);
  }
  EXPECT_GT(met, 15);
}

TEST(ShapeQueries, RefuseWhatIsNoShape) {
  World world = emptySpace();
  EXPECT_FALSE(world.overlapShape(planeOf(), {}).ok());
  EXPECT_FALSE(world.castShape(boxOf({0, 1, 1}), {}, {1, 0, 0}).ok());
  EXPECT_FALSE(world.castShape(boxOf({1, 1, 1}), {}, {std::nan(""), 0, 0}).ok());
  EXPECT_FALSE(world.castShape(boxOf({1, 1, 1}), {{0, 0, 0}, {0, 0, 0, 0}}, {1, 0, 0}).ok());
  EXPECT_FALSE(world.castRayAll({}, {0, 0, 0}, 1).ok());
  EXPECT_FALSE(world.castRayAll({}, {0, 0, 1}, -1).ok());
}

// --- Masses of one's own

TEST(GivenMass, MovesTheBodyAsIfItLaySo) {
  World world = emptySpace();
  BodyDef def = bodyOf(boxOf({0.5, 0.5, 0.5}), {});
  MassProperties given{5, {0.2, 0, 0}, diagonal(Vec3{0.5, 0.6, 0.7})};
  def.massProperties = given;
  const BodyId body = add(world, def);
  EXPECT_EQ(world.massProperties(body)->mass, 5);
  expectNear(world.state(body)->centreOfMass, {0.2, 0, 0}, 1e-15);
  ASSERT_TRUE(world.applyImpulseAtPoint(body, {0, 0, 10}, {0.2, 0.1, 0}).ok());
  expectNear(world.state(body)->linearVelocity, {0, 0, 2}, 1e-12);
  expectNear(world.state(body)->angularVelocity, {1 / 0.5, 0, 0}, 1e-12);
  // The shapes' own mass again, and back.
  ASSERT_TRUE(world.setMassProperties(body, {}).ok());
  EXPECT_NEAR(world.massProperties(body)->mass, 1000, 1e-9);
  ASSERT_TRUE(world.setMassProperties(body, given).ok());
  ASSERT_TRUE(world.setMaterial(world.shapes(body)[0], Material{.density = 7}).ok());
  EXPECT_EQ(world.massProperties(body)->mass, 5);
  World other = emptySpace();
  ASSERT_TRUE(other.restore(world.snapshot()).ok());
  EXPECT_EQ(other.massProperties(other.bodies()[0])->mass, 5);
  run(world, 0.5);
  run(other, 0.5);
  EXPECT_EQ(world.stateHash(), other.stateHash());
}

TEST(GivenMass, ThatCannotBeIsRefused) {
  World world = emptySpace();
  const BodyId body = addBox(world, {0.5, 0.5, 0.5}, {});
  const Mat3 fair = diagonal(Vec3{0.5, 0.6, 0.7});
  const std::uint64_t before = world.stateHash();
  for (const MassProperties& bad :
       {MassProperties{0, {}, fair}, MassProperties{-1, {}, fair}, MassProperties{5, {0.6, 0, 0}, fair},
        MassProperties{5, {}, diagonal(Vec3{0.1, 0.1, 0.5})}, MassProperties{5, {}, diagonal(Vec3{50, 50, 50})},
        MassProperties{std::nan(""), {}, fair}}) {
    const Status status = world.setMassProperties(body, bad);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("massProperties"), std::string::npos) << status.error().message;
    BodyDef def = bodyOf(boxOf({0.5, 0.5, 0.5}), {});
    def.massProperties = bad;
    EXPECT_FALSE(world.createBody(def).ok());
  }
  EXPECT_EQ(world.stateHash(), before);
  EXPECT_FALSE(world.setMassProperties({}, {}).ok());
}

// A stack with a mass of its own rests on the ground, and a heavy one that becomes light goes on resting.
TEST(GivenMass, CarriesWhatLiesOnIt) {
  World world = makeWorld();
  addGround(world);
  BodyDef def = bodyOf(boxOf({0.2, 0.1, 0.2}), {0, 0.1, 0});
  def.massProperties = MassProperties{40, {0, -0.05, 0}, diagonal(Vec3{0.4, 0.5, 0.4})};
  const BodyId low = add(world, def), high = addBox(world, {0.2, 0.1, 0.2}, {0, 0.3, 0});
  run(world, 1);
  ASSERT_TRUE(world.setMassProperties(low, MassProperties{4, {0, 0, 0}, diagonal(Vec3{0.04, 0.05, 0.04})}).ok());
  run(world, 1);
  EXPECT_NEAR(world.state(high)->position.y, 0.3, 2e-3);
  EXPECT_NEAR(world.state(low)->position.y, 0.1, 2e-3);
}

// --- Who may collide

TEST(ContactFilter, KeepsWhatItRefusesApartForEver) {
  World world = makeWorld();
  std::vector<std::pair<ShapeId, ShapeId>> asked;
  BodyId ghost, ground = addGround(world);
  ASSERT_TRUE(world
                  .setContactFilter([&](ShapeId a, ShapeId b) {
                    EXPECT_LT(a.index, b.index);
                    EXPECT_EQ(world.destroyBody(ghost).error().code, ErrorCode::wrongState);
                    asked.emplace_back(a, b);
                    const ShapeId refused = world.shapes(ghost)[0];
                    return refused != a && refused != b;
                  })
                  .ok());
  ghost = addBox(world, {0.2, 0.2, 0.2}, {0, 1, 0});
  const BodyId box = addBox(world, {0.2, 0.2, 0.2}, {2, 1, 0});
  const BodyId shot = add(world, bodyOf(sphereOf(0.05), {0, 1, 3}));
  ASSERT_TRUE(world.setLinearVelocity(shot, {0, 3, -300}).ok());  // through the ghost at once
  stepSound(world);
  EXPECT_LT(world.state(shot)->position.z, -1);
  run(world, 1);
  EXPECT_LT(world.state(ghost)->position.y, -2);
  EXPECT_NEAR(world.state(box)->position.y, 0.2, 2e-3);
  EXPECT_FALSE(asked.empty());
  EXPECT_TRUE(world.isValid(ground));
  // It stays with a world that is restored.
  const std::vector<std::byte> bytes = world.snapshot();
  asked.clear();
  ASSERT_TRUE(world.restore(bytes).ok());
  ASSERT_TRUE(world.setTransform(ghost, {0, 0.1, 0}, {}).ok());
  run(world, 0.5);
  EXPECT_LT(world.state(ghost)->position.y, -0.5);
}

// --- Sleep by call

TEST(SleepByCall, WhatRestsSleepsAtOnceAndWhatMovesGoesOn) {
  WorldDef def;
  def.sleepDelay = 1000;
  World world = makeWorld(def);
  const BodyId ground = addGround(world);
  const BodyId low = addBox(world, {0.2, 0.1, 0.2}, {0, 0.1, 0}), high = addBox(world, {0.2, 0.1, 0.2}, {0, 0.3, 0});
  const BodyId falling = addBox(world, {0.1, 0.1, 0.1}, {3, 5, 0});
  run(world, 0.8);
  EXPECT_TRUE(world.state(low)->awake);
  ASSERT_TRUE(world.sleep(high).ok());
  ASSERT_TRUE(world.sleep(falling).ok());
  stepSound(world);
  EXPECT_FALSE(world.state(low)->awake);
  EXPECT_FALSE(world.state(high)->awake);
  EXPECT_EQ(world.events().fellAsleep.size(), 2u);
  EXPECT_TRUE(world.state(falling)->awake);
  ASSERT_TRUE(world.sleep(low).ok());  // it does
  ASSERT_TRUE(world.wake(low).ok());
  stepSound(world);
  EXPECT_TRUE(world.state(high)->awake);
  EXPECT_EQ(world.sleep(ground).error().code, ErrorCode::wrongState);
  EXPECT_EQ(world.sleep({}).error().code, ErrorCode::staleId);
}

// --- Events that name shapes

TEST(HitEvents, NameTheShapesThatMet) {
  World world = makeWorld();
  const BodyId ground = addGround(world);
  BodyDef def = bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 2, 0});
  ShapeDef foot = boxOf({0.05, 0.05, 0.05});
  foot.local.position = {0, -0.15, 0};
  def.shapes.push_back(foot);
  const BodyId body = add(world, def);
  bool met = false;
  for (int i = 0; i < 60 && !met; i++) {
    stepSound(world);
    for (const HitEvent& hit : world.events().hits) {
      met = true;
      EXPECT_EQ(hit.shapeA, world.shapes(ground)[0]);
      EXPECT_EQ(hit.shapeB, world.shapes(body)[1]);
    }
  }
  EXPECT_TRUE(met);
}

// --- The host's threads and memory

class CountingTasks final : public TaskSystem {
 public:
  int loops = 0;
  int threads() const override { return 4; }
  void forRange(int count, int grain, const std::function<void(int, int)>& body) override {
    loops++;
    // Backwards, each piece on a thread of its own: nothing may depend on the order.
    for (int end = count; end > 0;) {
      const int begin = (end - 1) / grain * grain;
      std::thread(body, begin, end).join();
      end = begin;
    }
  }
};

TEST(Host, ThreadsAndMemoryOfTheProgramChangeNoBit) {
  CountingTasks tasks;
  CountingMemory memory;
  std::uint64_t hashes[2];
  for (bool hosted : {false, true}) {
    WorldDef def;
    if (hosted) {
      def.tasks = &tasks;
      def.memory = &memory;
    }
    World world = makeWorld(def);
    addGround(world);
    for (int tower = 0; tower < 6; tower++)
      for (int i = 0; i < 4; i++)
        addBox(world, {0.2, 0.1, 0.2}, {2.0 * tower + 0.02 * i, 0.3 + 0.22 * i, 0}, {0.1 * tower, 0, 0});
    run(world, 0.5);
    ASSERT_TRUE(world.restore(world.snapshot()).ok());
    run(world, 0.2);
    hashes[hosted] = world.stateHash();
    WorldDef other = world.definition();
    other.tasks = hosted ? nullptr : &tasks;
    EXPECT_FALSE(world.setDefinition(other).ok());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_GT(tasks.loops, 5);
  EXPECT_GT(memory.taken, 10000u);
  EXPECT_EQ(memory.held, 0u);
}

}  // namespace
}  // namespace brickfall
