// Settings and materials that change while a world runs: they act at once, whoever rested is looked at anew, and a snapshot
// holds them. And islands, as a program sees them.
#include <algorithm>
#include <set>

#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

Material materialOf(double density, double friction, double restitution = 0) {
  Material m;
  m.density = density;
  m.friction = friction;
  m.restitution = restitution;
  return m;
}

// A wall of 100 bricks that fell asleep.
lab::Scene sleepingWall() {
  lab::Options o;
  o.sleep = true;
  lab::Scene s = lab::make("w10", o);
  run(s.world, 1.5);
  EXPECT_FALSE(s.world.state(s.boxes[0])->awake);
  return s;
}

TEST(Settings, ActFromTheNextStepOn) {
  World world = makeWorld();
  BodyId box = addBox(world, {0.1, 0.1, 0.1}, {0, 5, 0});
  stepSound(world);
  WorldDef def = world.definition();
  def.gravity = {2, 0, 0};
  ASSERT_TRUE(world.setDefinition(def).ok());
  EXPECT_EQ(world.gravity(), def.gravity);
  Vec3 before = world.state(box)->linearVelocity;
  stepSound(world);
  expectNear(world.state(box)->linearVelocity - before, Vec3{2, 0, 0} * kDt, 1e-9);
}

TEST(Settings, OfTheBalanceWakeAWallThatSleeps) {
  struct Case {
    const char* what;
    void (*change)(WorldDef&);
    bool wakes;
  };
  for (Case c : {Case{"gravity", [](WorldDef& d) { d.gravity.y = -5; }, true},
                 {"air", [](WorldDef& d) { d.airDensity = 2; }, true},
                 {"stiffness", [](WorldDef& d) { d.solver.restingStiffness = 2000; }, true},
                 {"sleep off", [](WorldDef& d) { d.enableSleep = false; }, true},
                 {"delay", [](WorldDef& d) { d.sleepDelay = 3; }, false},
                 {"hits", [](WorldDef& d) { d.hitEventSpeed = 3; }, false},
                 {"threads", [](WorldDef& d) { d.threads = 2; }, false}}) {
    lab::Scene s = sleepingWall();
    WorldDef def = s.world.definition();
    c.change(def);
    ASSERT_TRUE(s.world.setDefinition(def).ok()) << c.what;
    stepSound(s.world);
    EXPECT_EQ(s.world.state(s.boxes[0])->awake, c.wakes) << c.what;
  }
}

TEST(Settings, WithoutSleepNothingFallsAsleepAgain) {
  lab::Scene s = sleepingWall();
  WorldDef def = s.world.definition();
  def.enableSleep = false;
  ASSERT_TRUE(s.world.setDefinition(def).ok());
  run(s.world, 1.5);
  for (BodyId box : s.boxes) EXPECT_TRUE(s.world.state(box)->awake);
}

TEST(Settings, AreRefusedWholeAndNameTheField) {
  World world = makeWorld();
  addBox(world, {0.1, 0.1, 0.1}, {0, 5, 0});
  const WorldDef good = world.definition();
  struct Case {
    const char* field;
    void (*spoil)(WorldDef&);
  };
  for (Case c : {Case{"gravity.y", [](WorldDef& d) { d.gravity.y = std::nan(""); }},
                 {"sleepDelay", [](WorldDef& d) { d.sleepDelay = 0; }},
                 {"solver.maxCycles", [](WorldDef& d) { d.solver.maxCycles = 0; }},
                 {"maxBodies", [](WorldDef& d) { d.maxBodies = 7; }},
                 {"broadPhase", [](WorldDef& d) { d.broadPhase = BroadPhaseMethod::allPairs; }},
                 {"solver.contactMargin", [](WorldDef& d) { d.solver.contactMargin = 0.02; }}}) {
    WorldDef def = good;
    def.gravity.x = 1;
    c.spoil(def);
    Status answer = world.setDefinition(def);
    ASSERT_FALSE(answer.ok()) << c.field;
    EXPECT_EQ(answer.error().message.rfind(c.field, 0), 0u) << answer.error().message;
    EXPECT_EQ(world.gravity(), good.gravity) << c.field;
  }
}

TEST(Settings, AreInTheSnapshot) {
  lab::Scene s = sleepingWall();
  WorldDef def = s.world.definition();
  def.gravity = {1, -4, 0};
  def.solver.maxCycles = 33;
  def.threads = 2;
  ASSERT_TRUE(s.world.setDefinition(def).ok());
  ASSERT_TRUE(s.world.setMaterial(s.world.shapes(s.boxes[7])[0], materialOf(3000, 0.2, 0.5)).ok());
  std::vector<std::byte> bytes = s.world.snapshot();
  run(s.world, 0.5);
  World other = makeWorld();
  ASSERT_TRUE(other.restore(bytes).ok());
  EXPECT_EQ(other.definition().solver.maxCycles, 33);
  EXPECT_EQ(other.definition().threads, 2);
  EXPECT_EQ(other.shape(other.shapes(other.bodies()[8])[0])->material.friction, 0.2);
  run(other, 0.5);
  EXPECT_EQ(other.stateHash(), s.world.stateHash());
}

// A box on a slope of 20 degrees that sleeps: with less friction it wakes and slides, a = g (sin - mu cos).
TEST(Settings, LessFrictionLetsABoxSlide) {
  const double slope = 20 * kPi / 180;
  WorldDef def;
  def.gravity = {kG * std::sin(slope), -kG * std::cos(slope), 0};
  World world = makeWorld(def);
  BodyId ground = addGround(world);
  BodyId box = addBox(world, {0.3, 0.1, 0.3}, {0, 0.1, 0});
  run(world, 1.5);
  ASSERT_FALSE(world.state(box)->awake);
  ASSERT_TRUE(world.setMaterial(world.shapes(box)[0], materialOf(1000, 0)).ok());
  ASSERT_TRUE(world.setMaterial(world.shapes(ground)[0], materialOf(1000, 0)).ok());
  run(world, 0.5);
  EXPECT_NEAR(world.state(box)->linearVelocity.x, kG * std::sin(slope) * 0.5, 0.02);
}

TEST(Settings, RestitutionOfABallOnTheGroundChanges) {
  World world = makeWorld();
  addGround(world);
  BodyId ball = add(world, bodyOf(sphereOf(0.1), {0, 1.1, 0}));
  ASSERT_TRUE(world.setMaterial(world.shapes(ball)[0], materialOf(1000, 0.6, 0.8)).ok());
  double apex = 0;
  bool down = false;
  for (int i = 0; i < 90; i++) {
    stepSound(world);
    BodyState s = *world.state(ball);
    down = down || s.linearVelocity.y > 0;
    if (down) apex = std::max(apex, s.position.y - 0.1);
  }
  EXPECT_NEAR(apex, 0.64, 0.03);
}

TEST(Settings, DensityChangesWhatTheGroundCarries) {
  World world = makeWorld();
  addGround(world);
  BodyId lower = addBox(world, {0.2, 0.1, 0.2}, {0, 0.1, 0}), upper = addBox(world, {0.2, 0.1, 0.2}, {0, 0.3, 0});
  run(world, 1.5);
  ASSERT_FALSE(world.state(lower)->awake);
  ASSERT_TRUE(world.setMaterial(world.shapes(upper)[0], materialOf(3000, 0.6)).ok());
  EXPECT_NEAR(world.state(upper)->mass, 3000 * 0.4 * 0.2 * 0.4, 1e-9);
  expectSound(world);
  run(world, 1);
  double force = 0;
  world.forEachContact([&](const ContactView& c) {
    for (int i = 0; i < c.pointCount && c.bodyB == lower; i++) force += c.points[i].normalForce;
  });
  EXPECT_NEAR(force, (1000 + 3000) * 0.032 * kG, 3);
  EXPECT_NEAR(world.state(lower)->position.y, 0.1, 1e-4);
  EXPECT_NEAR(world.state(upper)->position.y, 0.3, 1e-4);
}

// The frame stays where it is, the centre of mass does not.
TEST(Settings, DensityOfOnePartMovesTheCentreOfMass) {
  World world = makeWorld();
  addGround(world);
  BodyDef two = bodyOf(boxOf({0.1, 0.1, 0.1}), {-0.1, 0.1, 0});
  two.shapes.push_back(boxOf({0.1, 0.1, 0.1}));
  two.shapes[1].local.position = {0.2, 0, 0};
  BodyId body = add(world, two);
  run(world, 1);
  Vec3 place = world.state(body)->position;
  ASSERT_TRUE(world.setMaterial(world.shapes(body)[1], materialOf(3000, 0.6)).ok());
  expectNear(world.state(body)->position, place, 1e-12);
  EXPECT_NEAR(world.state(body)->centreOfMass.x, place.x + 0.15, 1e-9);
  expectSound(world);
  run(world, 1);
  expectNear(world.state(body)->position, place, 1e-4);
}

TEST(Settings, OfAMaterialAreRefusedAndNameTheField) {
  World world = makeWorld();
  addGround(world);
  BodyId box = addBox(world, {0.1, 0.1, 0.1}, {0, 0.1, 0});
  ShapeId shape = world.shapes(box)[0];
  auto refused = [&](const Material& m, const char* word) {
    Status answer = world.setMaterial(shape, m);
    EXPECT_FALSE(answer.ok());
    EXPECT_NE(answer.error().message.find(word), std::string::npos) << answer.error().message;
    EXPECT_EQ(world.shape(shape)->material.density, 1000);
  };
  refused(materialOf(0, 0.5), "material.density");
  refused(materialOf(std::nan(""), 0.5), "material.density");
  refused(materialOf(1000, -1), "material.friction");
  refused(materialOf(1000, 0.5, 1.5), "material.restitution");
  refused(materialOf(1e-14, 0.5), "mass");
  ASSERT_TRUE(world.destroyBody(box).ok());
  EXPECT_EQ(world.setMaterial(shape, materialOf(1000, 0.5)).error().code, ErrorCode::staleId);
}

// Each alone it may have, not both: 2 x 5.12e8 m3.
TEST(Settings, MaterialsOfABodyAreCheckedTogether) {
  World world = emptySpace();
  BodyDef two = bodyOf(boxOf({400, 400, 400}), {});
  two.shapes.push_back(boxOf({400, 400, 400}));
  const BodyId body = add(world, two);
  const Material light = materialOf(1000, 0.5), heavy = materialOf(1e6, 0.5);
  const std::uint64_t before = world.stateHash();
  const auto answer = [&](const std::vector<Material>& materials) {
    const Status status = world.checkMaterials(body, materials);
    return status.ok() ? std::string() : status.error().message;
  };
  EXPECT_EQ(answer({light, heavy}), "");
  EXPECT_EQ(answer({heavy, light}), "");
  EXPECT_NE(answer({heavy, heavy}).find("mass"), std::string::npos);
  EXPECT_NE(answer({light}).find("materials: found 1, expected 2"), std::string::npos);
  EXPECT_NE(answer({light, materialOf(1000, -1)}).find("materials[1].friction"), std::string::npos);
  EXPECT_EQ(world.stateHash(), before);
  EXPECT_EQ(world.shape(world.shapes(body)[0])->material.density, 1000);
  EXPECT_NE(checkMaterial(materialOf(std::nan(""), 0.5)).error().message.find("material.density"), std::string::npos);
  EXPECT_TRUE(checkMaterial(light).ok());
}

TEST(Settings, AllBricksOfAStandingWallMayBecomeHeavier) {
  lab::Scene s = sleepingWall();
  for (BodyId box : s.boxes) ASSERT_TRUE(s.world.setMaterial(s.world.shapes(box)[0], materialOf(2500, 0.7)).ok());
  expectSound(s.world);
  std::vector<Vec3> places;
  for (BodyId box : s.boxes) places.push_back(s.world.state(box)->position);
  run(s.world, 1);
  for (std::size_t i = 0; i < s.boxes.size(); i++)
    expectNear(s.world.state(s.boxes[i])->position, places[i], 1e-3, "brick");
}

TEST(Islands, AreSeenAwakeAndAsleep) {
  World world = makeWorld();
  addGround(world);
  std::vector<BodyId> stack;
  for (int i = 0; i < 3; i++) stack.push_back(addBox(world, {0.1, 0.1, 0.1}, {0, 0.1 + 0.2 * i, 0}));
  BodyId falling = addBox(world, {0.1, 0.1, 0.1}, {3, 40, 0});
  auto islandOfStack = [&](bool awake) {
    int found = 0;
    world.forEachIsland([&](const IslandView& island) {
      std::set<BodyId> in(island.bodies.begin(), island.bodies.end());
      EXPECT_FALSE(in.count(falling));
      if (in == std::set<BodyId>(stack.begin(), stack.end()) && island.awake == awake) found++;
      EXPECT_EQ(world.destroyBody(stack[0]).error().code, ErrorCode::wrongState);
    });
    return found;
  };
  run(world, 0.1);
  EXPECT_EQ(islandOfStack(true), 1);
  run(world, 1.2);
  ASSERT_FALSE(world.state(stack[0])->awake);
  EXPECT_EQ(islandOfStack(false), 1);
}

// Those of the lowest bodies first, whichever fell asleep first.
TEST(Islands, ThatSleepAreSeenInTheOrderOfTheirLowestBody) {
  World world = makeWorld();
  addGround(world);
  std::vector<BodyId> lowest;
  for (int column = 0; column < 3; column++)
    for (int i = 0; i < 2; i++) {  // the first falls the furthest
      const BodyId box = addBox(world, {0.1, 0.1, 0.1}, {3.0 * column, 0.1 + 0.2 * i + 0.5 * (2 - column), 0});
      if (i == 0) lowest.push_back(box);
    }
  std::vector<BodyId> order;
  for (int i = 0; i < 300; i++) {
    stepSound(world);
    for (BodyId body : world.events().fellAsleep)
      if (std::count(lowest.begin(), lowest.end(), body)) order.push_back(body);
  }
  ASSERT_EQ(order.size(), lowest.size());
  ASSERT_NE(order, lowest) << "so says nothing";
  std::vector<BodyId> seen;
  world.forEachIsland([&](const IslandView& island) { seen.push_back(island.bodies.front()); });
  EXPECT_EQ(seen, lowest);
}

}  // namespace
}  // namespace brickfall
