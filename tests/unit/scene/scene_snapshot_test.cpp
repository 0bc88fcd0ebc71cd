// A run as bytes: it goes on bit for bit, with its names, launches to come and changed settings; damaged bytes change nothing.
// And what of a scene changes while it runs.
#include <cmath>

#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

SceneRun made(const SceneDescription& scene) {
  Result<SceneRun> run = SceneRun::create(scene);
  EXPECT_TRUE(run.ok()) << run.error().message;
  return std::move(*run);
}

void advance(SceneRun& run, int steps) {
  for (int i = 0; i < steps; i++) ASSERT_TRUE(run.step().ok());
}

// A wall of default bricks (they rebound a little), a ball to come.
const char* const kShot = R"(
[[wall]]
name = "w"
courses = 5
bricks = 4
density_scatter = 0.1
[[ball]]
name = "shot"
radius = 0.1
material = "steel"
position = [0.4, 0.2, 1]
velocity = [0, 0, -8]
launch_time = 0.5
)";

PlacedBody extraBall() {
  PlacedBody ball;
  ball.name = "extra";
  ball.role = BodyRole::ball;
  ball.materials = {"rubber"};
  ball.def.position = {0.4, 2, 0};
  ball.def.shapes.resize(1);
  ball.def.shapes[0].type = ShapeType::sphere;
  ball.def.shapes[0].radius = 0.1;
  ball.launchTime = 0.8;
  return ball;
}

TEST(SceneSnapshot, GoesOnBitForBitFromAnyMoment) {
  SceneRun first = made(sound(kShot));
  constexpr int kSteps = 90;
  std::vector<std::vector<std::byte>> kept;
  std::vector<std::uint64_t> hashes;
  const auto act = [](SceneRun& run, int step) {
    if (step == 20) {
      ASSERT_TRUE(run.createBody(extraBall()).ok());
    }
    if (step == 40) {
      ASSERT_TRUE(run.setTimeStep(1.0 / 120, 2).ok());
    }
    if (step == 45) {
      ASSERT_TRUE(run.destroyBody(run.bodies()[3].id).ok());
    }
    advance(run, 1);
  };
  for (int i = 0; i < kSteps; i++) {
    if (i % 15 == 0) kept.push_back(first.snapshot());
    act(first, i);
    hashes.push_back(first.world().stateHash());
  }
  for (std::size_t k = 0; k < kept.size(); k++) {
    SceneRun again = made(sound(kShot));
    ASSERT_TRUE(again.restore(kept[k]).ok());
    EXPECT_EQ(again.stepCount(), 15 * k);
    for (int i = int(15 * k); i < kSteps; i++) {
      act(again, i);
      ASSERT_EQ(again.world().stateHash(), hashes[std::size_t(i)]) << "from " << 15 * k << ", after step " << i;
    }
    EXPECT_EQ(again.time(), first.time());
    EXPECT_EQ(again.bodies().size(), first.bodies().size());
    ASSERT_NE(again.find(first.world().bodies().empty() ? BodyId{} : again.bodies().back().id), nullptr);
    EXPECT_EQ(again.bodies().back().name, "extra");
    EXPECT_EQ(again.bodies().back().materials, std::vector<std::string>{"rubber"});
    EXPECT_EQ(again.bodies().back().def.shapes[0].radius, 0.1);
    EXPECT_EQ(again.scene().substeps, 2);
  }
}

TEST(SceneSnapshot, OfTheReportsSystemGoesOnBitForBit) {
  const SceneDescription scene = sound(R"(
[world]
method = "report"
[report]
all_axes = true
manifold = true
warm_starting = true
friction = true
[[wall]]
courses = 4
bricks = 3
)");
  SceneRun first = made(scene);
  advance(first, 30);
  EXPECT_FALSE(first.reported()->collisions().empty());
  const std::vector<std::byte> kept = first.snapshot();
  advance(first, 30);
  SceneRun again = made(scene);
  ASSERT_TRUE(again.restore(kept).ok());
  EXPECT_NEAR(again.time(), 0.5, 1e-9);
  advance(again, 30);
  EXPECT_EQ(again.world().stateHash(), first.world().stateHash());
  EXPECT_EQ(again.time(), first.time());
  SceneRun other = made(sound(kShot));
  EXPECT_FALSE(other.restore(kept).ok());
  EXPECT_EQ(other.stepCount(), 0u);
}

TEST(SceneSnapshot, DamagedBytesAreRefusedAndChangeNothing) {
  SceneRun run = made(sound(kShot));
  advance(run, 10);
  const std::vector<std::byte> good = run.snapshot();
  advance(run, 5);
  const std::uint64_t before = run.world().stateHash();
  const auto refused = [&](std::span<const std::byte> bytes, std::size_t at) {
    EXPECT_FALSE(run.restore(bytes).ok()) << at;
    EXPECT_EQ(run.world().stateHash(), before) << at;
    EXPECT_EQ(run.stepCount(), 15u) << at;
  };
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 40)
    refused(std::span(good).first(length), length);
  for (std::size_t at = 0; at < good.size(); at += 1 + good.size() / 60) {
    if (at >= 12 && at < 16) continue;  // not read
    std::vector<std::byte> bad = good;
    bad[at] ^= std::byte(0x41);
    refused(bad, at);
  }
  EXPECT_TRUE(run.restore(good).ok());
  EXPECT_EQ(run.stepCount(), 10u);
}

TEST(SceneSnapshot, ChangedMaterialsAndSettingsGoWithIt) {
  SceneRun run = made(sound(kShot));
  advance(run, 5);
  WorldDef def = run.world().definition();
  def.gravity.y = -3;
  ASSERT_TRUE(run.setWorld(def).ok());
  Material light = run.material("brick")->material;
  const double before = light.density;
  light.density = 500;
  light.friction = 0.3;
  const double mass = run.world().state(run.bodies()[2].id)->mass;
  ASSERT_TRUE(run.setMaterial("brick", light).ok());
  EXPECT_NEAR(run.world().state(run.bodies()[2].id)->mass, mass * 500 / before, 1e-9);
  EXPECT_EQ(run.world().shape(run.world().shapes(run.bodies()[2].id)[0])->material.friction, 0.3);
  const std::vector<std::byte> kept = run.snapshot();
  SceneRun again = made(sound(kShot));
  ASSERT_TRUE(again.restore(kept).ok());
  EXPECT_EQ(again.scene().world.gravity.y, -3);
  EXPECT_EQ(again.material("brick")->material.density, 500);
  advance(run, 20);
  advance(again, 20);
  EXPECT_EQ(again.world().stateHash(), run.world().stateHash());
}

TEST(SceneRun, RefusesChangesThatItCannotMake) {
  SceneRun run = made(sound(kShot));
  EXPECT_NE(run.setTimeStep(std::nan(""), 1).error().message.find("timeStep"), std::string::npos);
  EXPECT_NE(run.setTimeStep(0.01, 0).error().message.find("substeps"), std::string::npos);
  EXPECT_NE(run.setMaterial("cheese", {}).error().message.find("cheese"), std::string::npos);
  Material bad = run.material("brick")->material;
  bad.restitution = 2;
  const std::uint64_t before = run.world().stateHash();
  EXPECT_NE(run.setMaterial("brick", bad).error().message.find("restitution"), std::string::npos);
  EXPECT_EQ(run.material("brick")->material.restitution, 0.1);
  EXPECT_EQ(run.world().stateHash(), before);
  EXPECT_EQ(run.scene().timeStep, 1.0 / 60);
}

// A launch is due by time, whatever the time step was before.
TEST(SceneRun, LaunchesAtItsTimeUnderAnotherTimeStep) {
  SceneRun run = made(sound(kShot));
  advance(run, 6);
  ASSERT_TRUE(run.setTimeStep(0.01, 1).ok());
  advance(run, 40);
  EXPECT_NEAR(run.time(), 0.5, 1e-9);
  EXPECT_EQ(run.world().state(run.bodies().back().id)->type, BodyType::fixed);
  advance(run, 1);
  EXPECT_EQ(run.world().state(run.bodies().back().id)->type, BodyType::dynamic);
}

}  // namespace
}  // namespace brickfall
