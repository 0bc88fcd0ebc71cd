// Where two runs part: a change is found in the step and in the stage that it first touches, with the body. And the trace
// itself changes nothing.
#include <functional>

#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Found {
  int step = -1, substep = -1;
  std::string stage;
  BodyId bodyA, bodyB;
};

// First difference between two reports; step stays -1 if there is none.
bool firstDifference(const StepReport& a, const StepReport& b, int step, Found& found) {
  EXPECT_EQ(a.stageHashes.size(), b.stageHashes.size());
  for (std::size_t i = 0; i < std::min(a.stageHashes.size(), b.stageHashes.size()); i++) {
    const StageHash &x = a.stageHashes[i], &y = b.stageHashes[i];
    EXPECT_EQ(x.stage, y.stage);
    if (x.hash == y.hash) continue;
    found = {step, x.substep, std::string(nameOf(x)), {}, {}};
    for (std::size_t k = 0; k < std::min(x.items.size(), y.items.size()); k++)
      if (x.items[k].hash != y.items[k].hash) {
        found.bodyA = x.items[k].bodyA;
        found.bodyB = x.items[k].bodyB;
        return true;
      }
    return true;
  }
  return false;
}

Found whereTheyPart(
    World& a, World& b, int steps, int substeps = 1, const std::function<void(int)>& before = [](int) {}) {
  Found found;
  a.trace({true, true, false});
  b.trace({true, true, false});
  for (int i = 0; i < steps; i++) {
    before(i);
    Result<StepReport> x = a.step(kDt, substeps), y = b.step(kDt, substeps);
    EXPECT_TRUE(x.ok() && y.ok());
    EXPECT_EQ(x->stageHashes.size(), std::size_t(x->parts * (kStageCount + 1)));
    if (firstDifference(*x, *y, i, found)) break;
  }
  return found;
}

lab::Scene hitWall(double maxCycles = 8) {
  lab::Options o;
  o.solver.maxCycles = int(maxCycles);
  return lab::make("hit0", o);
}

TEST(StageTrace, equalRunsNeverPart) {
  lab::Scene a = hitWall(), b = hitWall();
  EXPECT_EQ(whereTheyPart(a.world, b.world, 20).step, -1);
}

TEST(StageTrace, oneVelocityOneUlpOffIsFoundInItsStepWithItsBody) {
  lab::Scene a = hitWall(), b = hitWall();
  const std::size_t brick = 6;
  Found found = whereTheyPart(a.world, b.world, 30, 1, [&](int step) {
    if (step != 17) return;
    Vec3 v = a.world.state(a.boxes[brick])->linearVelocity;
    ASSERT_TRUE(a.world.setLinearVelocity(a.boxes[brick], v).ok());
    v.x = std::nextafter(v.x, 1);
    ASSERT_TRUE(b.world.setLinearVelocity(b.boxes[brick], v).ok());
  });
  EXPECT_EQ(found.step, 17);
  EXPECT_EQ(found.substep, 0);
  EXPECT_EQ(found.stage, "given");
  EXPECT_EQ(found.bodyA.index, a.boxes[brick].index);
  EXPECT_FALSE(found.bodyB);
}

// A setting is read by one stage first: there the runs must part, not before and not after.
TEST(StageTrace, anotherSettingIsFoundInTheStageThatReadsIt) {
  struct Case {
    const char* stage;
    std::function<void(WorldDef&, ShapeDef&)> change;
  };
  const Case cases[] = {
      {"pairs", [](WorldDef& d, ShapeDef&) { d.solver.contactMargin *= 0.9; }},
      {"contacts", [](WorldDef&, ShapeDef& s) { s.material.friction *= 1.0001; }},
      {"prepare", [](WorldDef& d, ShapeDef&) { d.airDensity *= 1.0001; }},
      {"rest", [](WorldDef& d, ShapeDef&) { d.solver.restTolerance = 0.9; }},
      // By less an impact, which is solved as far as floats tell, is the same.
      {"impacts", [](WorldDef& d, ShapeDef&) { d.solver.restingStiffness *= 1.5; }},
      {"sleep", [](WorldDef& d, ShapeDef&) { d.sleepDelay = 0.25; }},
      {"events", [](WorldDef& d, ShapeDef&) { d.hitEventSpeed = 3; }},
  };
  for (const Case& c : cases) {
    auto build = [&](bool changed) {
      WorldDef def;
      ShapeDef shape = boxOf({0.1, 0.1, 0.1});
      shape.material.restitution = 0.3;
      if (changed) c.change(def, shape);
      World world = makeWorld(def);
      addGround(world);
      for (int i = 0; i < 3; i++) {
        BodyDef d = bodyOf(shape, {0.02 * i, 0.3 + 0.25 * i, 0});
        d.dragArea = 0.01;
        d.linearVelocity = {0, -1, 0};
        add(world, d);
      }
      return world;
    };
    World a = build(false), b = build(true);
    Found found = whereTheyPart(a, b, 240);
    EXPECT_GE(found.step, 0) << "never parted: " << c.stage;
    EXPECT_EQ(found.stage, c.stage) << "step " << found.step;
    EXPECT_TRUE(found.bodyA) << c.stage;
  }
}

TEST(StageTrace, aContactIsNamedByItsTwoBodies) {
  auto build = [](double friction) {
    World world = makeWorld();
    addGround(world);
    for (int i = 0; i < 4; i++)
      add(world, bodyOf(boxOf({.1, .1, .1}, 1000, i == 3 ? friction : 0.6), {0, .1 + .2 * i, 0}));
    return world;
  };
  World a = build(0.6), b = build(0.7);
  Found found = whereTheyPart(a, b, 5);
  EXPECT_EQ(found.step, 0);
  EXPECT_EQ(found.stage, "contacts");
  EXPECT_EQ(found.bodyA.index, 4u);
  EXPECT_EQ(found.bodyB.index, 5u);
}

TEST(StageTrace, substepsAreToldApart) {
  lab::Scene a = hitWall(), b = hitWall();
  WorldDef def;
  def.hitEventSpeed = 100;
  World quiet = makeWorld(def), loud = makeWorld();
  for (World* world : {&quiet, &loud}) {
    addGround(*world);
    addBox(*world, {.1, .1, .1}, {0, 0.19, 0}, {0, -6, 0});
  }
  Found found = whereTheyPart(quiet, loud, 2, 4);
  EXPECT_EQ(found.step, 0);
  EXPECT_EQ(found.substep, 3);  // 90 mm at 6 m/s: 15 ms, in the fourth quarter of the step
  EXPECT_EQ(found.stage, "events");
}

TEST(StageTrace, changesNoResultAndLeavesNothingWhenOff) {
  lab::Scene plain = hitWall(), traced = hitWall();
  traced.world.trace({true, true, true});
  for (int i = 0; i < 20; i++) {
    Result<StepReport> a = plain.world.step(kDt), b = traced.world.step(kDt);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_TRUE(a->stageHashes.empty());
    EXPECT_FALSE(a->ledger);
    EXPECT_TRUE(b->ledger);
    ASSERT_EQ(plain.world.stateHash(), traced.world.stateHash());
  }
  traced.world.trace({});
  EXPECT_TRUE(traced.world.step(kDt)->stageHashes.empty());
}

// Not only poses and velocities: what contacts and islands remember comes through a snapshot as well.
TEST(StageTrace, aRestoredWorldGoesThroughTheSameStagesAtEveryStep) {
  for (const char* name : {"hit0", "drop", "tumble", "cor30", "w10"}) {
    lab::Options o;
    o.restitution = 0.3;
    o.sleep = true;
    lab::Scene a = lab::make(name, o), b = lab::make(name, o);
    Found found = whereTheyPart(a.world, b.world, 45, 1, [&](int step) {
      std::vector<std::byte> bytes = b.world.snapshot();
      ASSERT_TRUE(b.world.restore(bytes).ok()) << name << " step " << step;
    });
    EXPECT_EQ(found.step, -1) << name << ": " << found.stage << ", body " << found.bodyA.index;
  }
}

}  // namespace
}  // namespace brickfall
