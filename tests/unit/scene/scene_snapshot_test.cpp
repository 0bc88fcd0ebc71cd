// A run as bytes: it goes on bit for bit, with its names, launches to come and changed settings; damaged bytes change nothing.
// And what of a scene changes while it runs.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/hash.h"
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
[[material]]
name = "clay"
density = 1234.5
[[material]]
name = "lead"
density = 11340
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

const char* const kReported = R"(
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
)";

TEST(SceneSnapshot, OfTheReportsSystemGoesOnBitForBit) {
  const SceneDescription scene = sound(kReported);
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

constexpr std::size_t kHeader = 32, kWorldBytesAt = 16, kHashAt = 24;  // src/scene/scene_snapshot.cpp

std::size_t ownPartOf(const std::vector<std::byte>& bytes) {
  std::uint64_t worldBytes = 0;
  std::memcpy(&worldBytes, bytes.data() + kWorldBytesAt, sizeof worldBytes);
  return kHeader + std::size_t(worldBytes);
}

template <class T> void put(std::vector<std::byte>& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

// What an attacker does: bytes of the run's own part changed, and the checksum made right again.
std::vector<std::byte> sealed(std::vector<std::byte> bytes) {
  Hash hash;
  for (std::size_t k = ownPartOf(bytes); k < bytes.size(); k++) hash.addByte(std::uint8_t(bytes[k]));
  put(bytes, kHashAt, hash.value());
  return bytes;
}

// Where these bytes stand in the run's own part.
std::size_t placeOf(const std::vector<std::byte>& bytes, std::span<const std::byte> wanted) {
  const auto from = bytes.begin() + std::ptrdiff_t(ownPartOf(bytes));
  const auto found = std::search(from, bytes.end(), wanted.begin(), wanted.end());
  EXPECT_NE(found, bytes.end());
  return std::size_t(found - bytes.begin());
}
std::size_t placeOf(const std::vector<std::byte>& bytes, const double& number) {
  return placeOf(bytes, std::as_bytes(std::span(&number, 1)));
}

TEST(SceneSnapshot, ForgedNumbersAreRefused) {
  SceneRun run = made(sound(std::string(kShot) + "[[ball]]\nposition = [9, 1, 0]\nlaunch_time = 0.4375\n"));
  advance(run, 10);
  const std::vector<std::byte> good = run.snapshot();
  advance(run, 5);
  const std::vector<std::byte> before = run.snapshot();
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const auto refused = [&](const std::vector<std::byte>& bytes, const char* word) {
    const Status answer = run.restore(sealed(bytes));
    ASSERT_FALSE(answer.ok()) << word;
    EXPECT_NE(answer.error().message.find(word), std::string::npos) << answer.error().message;
    EXPECT_EQ(run.snapshot(), before) << word;
  };
  const auto with = [&](std::size_t at, auto value) {
    std::vector<std::byte> bytes = good;
    put(bytes, at, value);
    return bytes;
  };
  const std::size_t own = ownPartOf(good), density = placeOf(good, 1234.5), launch = placeOf(good, 0.4375);
  refused(with(own, infinity), "time");
  refused(with(own + 8, nan), "time");
  refused(with(density, nan), "clay\": material.density");
  refused(with(density + 8, -1.0), "friction");
  refused(with(density + 16, infinity), "restitution");
  refused(with(launch, nan), "number");
  // Before a name: the body's slot and generation, the name's length.
  const auto slotOf = [&](const char* name) {
    const std::string text = name;
    return placeOf(good, std::as_bytes(std::span(text))) - 8 - 6;
  };
  std::uint32_t other = 0;
  std::memcpy(&other, good.data() + slotOf("w/0/1"), sizeof other);
  refused(with(slotOf("w/0/2"), other), "twice");
  EXPECT_TRUE(run.restore(sealed(good)).ok());
}

// The world's bytes are the last to be read: what its own checksum finds must not have changed the report's system.
TEST(SceneSnapshot, OfTheReportsSystemRefusedChangesNothing) {
  SceneRun run = made(sound(kReported));
  advance(run, 25);
  std::vector<std::byte> bad = run.snapshot();
  bad[kHeader + 100] ^= std::byte(1);
  advance(run, 5);
  const auto collisions = run.reported()->collisions();
  ASSERT_FALSE(collisions.empty());
  const std::vector<std::byte> before = run.snapshot();
  EXPECT_FALSE(run.restore(bad).ok());
  EXPECT_EQ(run.reported()->collisions(), collisions);
  EXPECT_EQ(run.snapshot(), before);
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

TEST(SceneRun, MaterialsThatNothingIsMadeOfAreCheckedToo) {
  SceneRun run = made(sound(kShot));
  Material bad = run.material("lead")->material;
  bad.density = std::nan("");
  EXPECT_NE(run.setMaterial("lead", bad).error().message.find("material.density"), std::string::npos);
  bad.density = 1000;
  bad.friction = -1;
  EXPECT_NE(run.setMaterial("rubber", bad).error().message.find("material.friction"), std::string::npos);
  EXPECT_EQ(run.material("lead")->material.density, 11340);
  EXPECT_EQ(run.material("rubber")->material.friction, 0.9);
  SceneDescription scene = run.scene();
  for (MaterialDef& def : scene.materials)
    if (def.name == "lead") def.material.restitution = 2;
  EXPECT_NE(SceneRun::create(scene).error().message.find("material \"lead\": material.restitution"), std::string::npos);
}

TEST(SceneRun, AChangedMaterialStaysInItsPlace) {
  SceneDescription scene = sound(kShot);
  std::erase_if(scene.materials, [](const MaterialDef& def) { return def.name == "brick"; });  // but predefined
  SceneRun run = made(scene);
  Material heavy = run.material("clay")->material;
  heavy.density = 3000;
  std::vector<std::string> names;
  for (const MaterialDef& def : scene.materials) names.push_back(def.name);
  ASSERT_NE(names.back(), "clay");
  names.push_back("brick");
  ASSERT_TRUE(run.setMaterial("clay", heavy).ok());
  ASSERT_TRUE(run.setMaterial("brick", heavy).ok());
  std::vector<std::string> now;
  for (const MaterialDef& def : run.scene().materials) now.push_back(def.name);
  EXPECT_EQ(now, names);
  EXPECT_EQ(run.material("clay")->material.density, 3000);
}

// With scattered densities some bricks would be too heavy. Found before the first is changed: what sleeps sleeps on.
TEST(SceneRun, AMaterialThatOneBodyCannotHaveChangesNothing) {
  SceneRun run = made(sound(kShot));
  ASSERT_TRUE(run.destroyBody(run.bodies().back().id).ok());  // the ball
  advance(run, 120);
  ASSERT_FALSE(run.world().state(run.bodies()[1].id)->awake);
  const std::vector<std::byte> before = run.snapshot();
  Material dense = run.material("brick")->material;
  // The first could just have it.
  dense.density *= 0.999e7 / run.world().shape(run.world().shapes(run.bodies()[1].id)[0])->material.density;
  ASSERT_LT(dense.density, 1e7);
  const Status answer = run.setMaterial("brick", dense);
  ASSERT_FALSE(answer.ok());
  EXPECT_TRUE(has(answer.error().message, "body \"w/")) << answer.error().message;
  EXPECT_FALSE(has(answer.error().message, "w/0/0")) << "not the first";
  EXPECT_TRUE(has(answer.error().message, "density")) << answer.error().message;
  EXPECT_EQ(run.snapshot(), before);
}

TEST(SceneRun, AQuarantinedBodyDoesNotHoldItsMaterial) {
  SceneRun run = made(sound(kShot));
  const BodyId lost = run.bodies()[1].id, other = run.bodies()[2].id;
  for (int i = 0; i < 100 && !run.world().state(lost)->quarantined; i++) {
    ASSERT_TRUE(run.world().applyForce(lost, {0, 0, 1e12}).ok());
    advance(run, 1);
  }
  ASSERT_TRUE(run.world().state(lost)->quarantined);
  Material smooth = run.material("brick")->material;
  smooth.friction = 0.25;
  ASSERT_TRUE(run.setMaterial("brick", smooth).ok());
  EXPECT_EQ(run.world().shape(run.world().shapes(other)[0])->material.friction, 0.25);
  EXPECT_EQ(run.material("brick")->material.friction, 0.25);
}

// When it is asked for, not when it is due: then no step would go on.
TEST(SceneRun, ALaunchThatCannotBeIsRefused) {
  SceneRun run = made(sound(kShot));
  const std::size_t before = run.bodies().size();
  const auto refused = [&](const PlacedBody& body, const char* word) {
    const Result<BodyId> made = run.createBody(body);
    ASSERT_FALSE(made.ok()) << word;
    EXPECT_TRUE(has(made.error().message, std::string("body \"extra\": ") + word)) << made.error().message;
    EXPECT_EQ(run.bodies().size(), before);
    EXPECT_EQ(run.world().bodies().size(), before);
  };
  PlacedBody ball = extraBall();
  ball.launchTime = std::nan("");
  refused(ball, "launchTime: found nan");
  ball = extraBall();
  ball.def.linearVelocity.x = 1e6;
  refused(ball, "linearVelocity.x");
  ball = extraBall();
  ball.def.shapes[0].type = ShapeType::plane;
  refused(ball, "shapes[0].type");
  // What never moves is not launched.
  ball = extraBall();
  ball.def.type = BodyType::fixed;
  ASSERT_TRUE(run.createBody(ball).ok());
  advance(run, 60);
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
