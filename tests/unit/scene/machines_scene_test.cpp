// Machines in scene files: what is read, what is refused and where, runs that go on from any moment, and the shipped scenes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

const char* const kAll = R"(
[[body]]
name = "table"
type = "kinematic"
size = [3, 0.2, 3]
position = [0, 0.1, 0]
[[body.key]]
time = 0.2
[[body.key]]
time = 0.6
position = [0, 0.3, 0]
rotation_degrees = [0, 30, 0]
[[tilt]]
body = "table"
from = 0.4
rate_degrees = 20
to_degrees = 5
[[shake]]
body = "table"
from = 0.5
amplitude = 3
seconds = 0.5
frequency = 5
[[shake]]
signal = "square_pulse"
seconds = 0.1
from = 0.3
direction = [0, 0, 1]
[[wind]]
velocity = [8, 0, 3]
from = 0.2
until = 0.9
ramp = 0.1
[[blast]]
centre = [0.3, 0.6, 0.3]
impulse = 40
radius = 2
time = 0.7
[[ball]]
name = "shot"
radius = 0.05
position = [0, 0.8, 2]
target = [0, 0.4, 0]
speed = 9
launch_times = [0.25, 0.5, 0.75]
[[array]]
name = "box"
count = [2, 3, 2]
size = [0.2, 0.2, 0.2]
position = [0, 0.2, 0]
)";

TEST(MachineScene, GoesOnBitForBitFromAnyMomentAndForAnyThreads) {
  SceneDescription scene = sound(kAll);
  Result<SceneRun> first = SceneRun::create(scene);
  ASSERT_TRUE(first.ok()) << first.error().message;
  std::vector<std::vector<std::byte>> kept;
  std::vector<std::uint64_t> hashes;
  for (int k = 0; k < 72; k++) {
    if (k % 9 == 0) kept.push_back(first->snapshot());
    ASSERT_TRUE(first->step().ok());
    hashes.push_back(first->world().stateHash());
  }
  EXPECT_EQ(std::count_if(first->bodies().begin(), first->bodies().end(),
                          [](const PlacedBody& body) { return body.name.starts_with("shot/"); }),
            3);
  scene.world.threads = 3;
  for (std::size_t k = 0; k < kept.size(); k++) {
    Result<SceneRun> other = SceneRun::create(scene);
    ASSERT_TRUE(other->restore(kept[k]).ok());
    for (std::size_t step = 9 * k; step < hashes.size(); step++) {
      ASSERT_TRUE(other->step().ok());
      ASSERT_EQ(other->world().stateHash(), hashes[step]) << "from step " << 9 * k;
    }
  }
}

TEST(MachineScene, TellsWhereSomethingIsWrong) {
  const std::string table = "[[body]]\nname = \"t\"\ntype = \"kinematic\"\n[[body]]\nname = \"b\"\n";
  EXPECT_TRUE(has(
      faults(table + "[[tilt]]\nbody = \"tt\"\nrate_degrees = 1\nto_degrees = 3\n"),
      "test.toml:7:8: error: tilt[0].body: found \"tt\", expected the name of a kinematic body (did you mean \"t\"?)"));
  EXPECT_TRUE(has(faults(table + "[[tilt]]\nbody = \"b\"\nrate_degrees = 1\nto_degrees = 3\n"),
                  "test.toml:7:8: error: tilt[0].body: found \"b\", which is not kinematic"));
  EXPECT_TRUE(has(faults(table + "[[tilt]]\nbody = \"t\"\n"), "test.toml:6:1: error: tilt[0]: found no [[tilt.key]]"));
  EXPECT_TRUE(
      has(faults(table + "[[tilt]]\n[[tilt.key]]\ntime = 1\ndegrees = 0\n[[tilt.key]]\ntime = 1\ndegrees = 3\n"),
          "test.toml:11:8: error: tilt[0].key[1].time: found 1 s after a key at 1 s, expected times that ascend"));
  EXPECT_TRUE(has(faults(table + "[[shake]]\nsignal = \"record\"\nfile = \"x.csv\"\n"),
                  "test.toml:6:1: error: shake[0].unit: not given, expected that of the record"));
  EXPECT_TRUE(has(faults(table + "[[shake]]\nsignal = \"record\"\nfile = \"x.csv\"\nunit = \"gal\"\n"),
                  "test.toml:9:8: error: shake[0].unit: found the text \"gal\", expected \"m/s2\""));
  EXPECT_TRUE(has(faults(table + "[[shake]]\nsignal = \"record\"\nfile = \"x.csv\"\nunit = \"g\"\n"),
                  "test.toml:8:8: error: shake[0].file: x.csv: there is no such file, expected a record"));
  EXPECT_TRUE(
      has(faults(table + "[[shake]]\nframe = 1\nunit = \"g\"\n"), "error: shake[0].frame: found an unknown key"));
  EXPECT_TRUE(has(faults(table + "[[shake]]\nunit = \"g\"\n"), "shake[0].unit: found with another signal"));
  EXPECT_TRUE(has(faults(table + "[[wind]]\nvelocity = [1, 0, 0]\nfrom = 3\nuntil = 2\n"), "wind[0].until: found 2 s"));
  EXPECT_TRUE(has(faults(table + "[[blast]]\nimpulse = 3\nradius = 2\n"), "blast[0].centre: not given"));
  EXPECT_TRUE(has(faults("[[ball]]\nposition = [0, 1, 0]\ntarget = [90, 1, 0]\nspeed = 5\n"),
                  "test.toml:4:9: error: ball[0].speed: found 5.000000 m/s, expected at least 29.71"));
  EXPECT_TRUE(has(faults("[[ball]]\nposition = [0, 1, 0]\ntarget = [90, 1, 0]\n"),
                  "found one of target (or aim_at) and speed alone"));
  EXPECT_TRUE(has(faults("[[ball]]\nposition = [0, 1, 0]\nlaunch_times = [1, 3, 2]\n"),
                  "test.toml:3:23: error: ball[0].launch_times[2]: found 2 after 3, expected times that ascend"));
  EXPECT_TRUE(has(faults("[[body]]\n[[body.key]]\ntime = 1\n"), "body[0].key: found on a body that is not kinematic"));
  EXPECT_TRUE(has(faults(table + "[[arch]]\nthickness = 3\n"), "arch[0].thickness: found 3 m"));
}

TEST(JointScene, TellsWhereSomethingIsWrong) {
  const std::string body = "[[body]]\nname = \"b\"\nposition = [0, 2, 0]\n[[joint]]\n";
  const std::string to = body + "body_b = \"b\"\nanchor = [0, 3, 0]\n";
  EXPECT_TRUE(has(faults(body + "anchor = [0, 3, 0]\n"), "test.toml:4:1: error: joint[0].body_b: not given"));
  EXPECT_TRUE(
      has(faults(body + "body_b = \"c\"\nanchor = [0, 3, 0]\n"),
          "test.toml:5:10: error: joint[0].body_b: found \"c\", expected the name of a body (did you mean \"b\"?)"));
  EXPECT_TRUE(has(faults(body + "body_b = \"b\"\nbody_a = \"b\"\nanchor = [0, 3, 0]\n"),
                  "test.toml:4:1: error: joint[0]: bodyB: found the same body as bodyA"));
  EXPECT_TRUE(has(faults("[ground]\nenabled = false\n" + to),
                  "joint[0].body_a: not given, expected the name of a body: there is no"));
  EXPECT_TRUE(has(faults(to + "lower_degrees = -3\n"), "joint[0].lower_degrees: found one end of the range alone"));
  EXPECT_TRUE(has(faults(to + "axis = [0, 0, 0]\n"), "joint[0].axis: found a vector of length 0"));
  EXPECT_TRUE(
      has(faults(to + "stiffness = 3\n"), "joint[0].stiffness: found a key that this type of joint does not have"));
  EXPECT_TRUE(has(faults(to + "type = \"distance\"\n"), "found"));
  EXPECT_TRUE(
      has(faults("[[body]]\n[[chain]]\nfrom = [0, 1, 0]\nto = [0, 1, 0]\n"), "chain[0].to: found links of 0 m"));
  EXPECT_TRUE(has(faults("[[body]]\n[[chain]]\nfrom = [0, 9, 0]\nto = [0, 8, 0]\nlinks = 4\nradius = 0.2\n"),
                  "chain[0].radius: found 0.2 m with links of 0.25 m"));
  EXPECT_TRUE(has(faults("[[body]]\n[[chain]]\nfrom = [0, 9, 0]\nto = [0, 8, 0]\nhinge_axis = [0, 1, 0]\n"),
                  "chain[0].hinge_axis: found one along the chain"));
  EXPECT_TRUE(has(faults("[[body]]\n[[chain]]\nfrom = [0, 9, 0]\nto = [0, 8, 0]\nhinge_friction = 2\n"),
                  "chain[0].hinge_friction: found on a chain of ball joints"));
}

// A ball that waits is joined, and held; then it swings, and its chain holds it. Snapshots keep all of it.
TEST(JointScene, ABallOnAChainWaitsAndSwings) {
  const char* const text = R"(
[[ball]]
name = "bob"
radius = 0.1
position = [1.1, 3, 0]
launch_time = 0.2
[[chain]]
name = "c"
body_b = "bob"
from = [0, 3, 0]
to = [1, 3, 0]
links = 5
radius = 0.01
)";
  Result<SceneRun> run = SceneRun::create(sound(text));
  ASSERT_TRUE(run.ok()) << run.error().message;
  ASSERT_EQ(run->joints().size(), 6u);
  EXPECT_EQ(run->joints()[5].second, "c.5");
  const BodyId bob =
      std::find_if(run->bodies().begin(), run->bodies().end(), [](auto& b) { return b.name == "bob"; })->id;
  for (int k = 0; k < 12; k++) ASSERT_TRUE(run->step().ok());
  EXPECT_EQ(run->world().state(bob)->position.y, 3);
  const std::vector<std::byte> kept = run->snapshot();
  for (int k = 0; k < 40; k++) ASSERT_TRUE(run->step().ok());
  EXPECT_LT(run->world().state(bob)->position.y, 2.3);
  EXPECT_NEAR(length(run->world().state(bob)->position - Vec3{0, 3, 0}), 1.1, 0.01);
  EXPECT_TRUE(run->world().validate().empty());
  Result<SceneRun> other = SceneRun::create(sound(text));
  ASSERT_TRUE(other->restore(kept).ok());
  for (int k = 0; k < 40; k++) ASSERT_TRUE(other->step().ok());
  EXPECT_EQ(other->world().stateHash(), run->world().stateHash());
}

// A joint of two bodies that are held sleeps with whatever falls asleep beside it; it must hold from the launch on.
TEST(JointScene, APendulumThatWaitedWhileOthersFellAsleepSwings) {
  const char* const text = R"(
[[body]]
name = "box"
position = [5, 0.5, 0]
[[body]]
name = "arm"
size = [1, 0.1, 0.1]
position = [0.5, 3, 0]
launch_time = 1
[[joint]]
type = "revolute"
body_b = "arm"
anchor = [0, 3, 0]
axis = [0, 0, 1]
)";
  Result<SceneRun> run = SceneRun::create(sound(text));
  ASSERT_TRUE(run.ok()) << run.error().message;
  while (run->time() < 0.99) ASSERT_TRUE(run->step().ok());
  ASSERT_FALSE(run->world().state(run->bodies()[1].id)->awake);
  while (run->time() < 2) {
    ASSERT_TRUE(run->step().ok());
    EXPECT_NEAR(length(run->world().state(run->bodies()[2].id)->position - Vec3{0, 3, 0}), 0.5, 1e-3);
  }
  EXPECT_TRUE(run->world().validate().empty());
}

// Of a record the line is named, in its own file.
TEST(MachineScene, TellsTheLineOfARecord) {
  const std::string path = (std::filesystem::temp_directory_path() / "brickfall_gap_record.csv").string();
  std::ofstream(path) << "t,a\n0,1\n0.1,\n0.2,1\n";
  const std::string found = faults("[[body]]\n[[shake]]\nsignal = \"record\"\nunit = \"g\"\nfile = \"" + path + "\"\n");
  EXPECT_TRUE(has(found, "test.toml:5:8: error: shake[0].file: " + path + ":3: found nothing in column 2")) << found;
  std::remove(path.c_str());
}

// A shipped scene, run to a time.
SceneRun ranTo(const std::string& name, double seconds, const Overrides& overrides = {}) {
  SceneLoad load = loadSceneFile(findScene(name), overrides);
  if (!load.scene) {
    ADD_FAILURE() << name << "\n" << allOf(load.diagnostics);
    load.scene = sound("[[body]]\n");
  }
  Result<SceneRun> made = SceneRun::create(*load.scene);
  SceneRun run = std::move(*made);
  while (run.time() < seconds - 1e-9)
    if (Result<StepReport> report = run.step(); !report) {
      ADD_FAILURE() << name << ": " << report.error().message;
      break;
    }
  EXPECT_TRUE(run.world().validate().empty()) << name << ": " << run.world().validate().front();
  return run;
}
double heightOf(const SceneRun& run, const std::string& name) {
  for (const PlacedBody& body : run.bodies())
    if (body.name == name) return run.world().state(body.id)->position.y;
  ADD_FAILURE() << name << " is not there";
  return 0;
}

TEST(MachineScene, DominoesFallToTheLast) {
  const SceneRun run = ranTo("dominoes", 3, {{"n", "25"}});
  EXPECT_LT(heightOf(run, "domino/0"), 0.02);
  EXPECT_LT(heightOf(run, "domino/23"), 0.02);
  EXPECT_LT(heightOf(run, "domino/24"), 0.01) << "the last lies flat";
}

TEST(MachineScene, AnArchStandsOrFallsByItsThickness) {
  EXPECT_GT(heightOf(ranTo("arch", 4), "arch/10"), 0.999);
  EXPECT_LT(heightOf(ranTo("arch", 4, {{"ratio", "0.1"}}), "arch/10"), 0.5);
}

TEST(MachineScene, ADomeStandsUntilABallComes) {
  const Overrides few = {{"rings", "5"}, {"stones", "12"}};
  const auto with = [&](const char* key, const char* value) {
    Overrides all = few;
    all.push_back({key, value});
    return all;
  };
  const double crown = heightOf(ranTo("dome", 0.1, few), "dome/key");
  EXPECT_GT(heightOf(ranTo("dome", 2, few), "dome/key"), crown - 1e-3);
  EXPECT_LT(heightOf(ranTo("dome", 1.5, with("ratio", "0.03")), "dome/key"), crown - 0.5);
  EXPECT_LT(heightOf(ranTo("dome", 1.5, with("drum", "0.05")), "dome/key"), crown - 0.5);
  EXPECT_LT(heightOf(ranTo("dome", 1.5, with("launch", "0.2")), "dome/key"), crown - 0.5);
}

// A small house is broken, the chain stays whole: its links are as long as they were.
TEST(JointScene, AWreckingBallBreaksAHouseAndItsChainHolds) {
  const SceneRun run = ranTo("wrecking-ball", 2.15, {{"front", "7"}, {"side", "4"}});
  int moved = 0;
  for (const PlacedBody& body : run.bodies())
    moved += body.role == BodyRole::brick && length(run.world().state(body.id)->position - body.def.position) > 0.1;
  EXPECT_GT(moved, 10);
  const auto joints = run.joints();
  ASSERT_EQ(joints.size(), 8u);
  for (const auto& [id, name] : joints) EXPECT_LT(run.world().state(id)->error, 2e-3) << name;
}

TEST(JointScene, APendulumGoesThroughAWallOnItsHinge) {
  const SceneRun run = ranTo("pendulum-wall", 2.4, {{"courses", "8"}, {"bricks", "6"}});
  int moved = 0;
  for (const PlacedBody& body : run.bodies())
    moved += body.role == BodyRole::brick && length(run.world().state(body.id)->position - body.def.position) > 0.1;
  EXPECT_GT(moved, 5);
  EXPECT_LT(run.world().state(run.joints().at(0).first)->error, 2e-3);
}

TEST(JointScene, ABridgeBearsItsCrate) {
  const SceneRun run = ranTo("bridge", 4);
  EXPECT_GT(heightOf(run, "crate"), 1.5);
  for (const auto& [id, name] : run.joints()) EXPECT_LT(run.world().state(id)->error, 2e-3) << name;
}

// One of five equal balls comes, one goes, with its speed.
TEST(JointScene, ACradleHandsTheBlowThrough) {
  SceneLoad load = loadSceneFile(findScene("cradle"));
  ASSERT_TRUE(load.scene.has_value()) << allOf(load.diagnostics);
  Result<SceneRun> run = SceneRun::create(*load.scene);
  const auto spinOf = [&](const char* name) {
    for (const PlacedBody& body : run->bodies())
      if (body.name == name) return run->world().state(body.id)->angularVelocity.z;
    return 0.0;
  };
  double came = 0, went = 0;
  while (run->time() < 0.46) {
    ASSERT_TRUE(run->step().ok());
    came = std::max(came, spinOf("first"));
    went = std::max(went, spinOf("fifth"));
  }
  EXPECT_NEAR(went, came, 0.02 * came);
  for (const char* name : {"first", "second", "third", "fourth"}) EXPECT_NEAR(spinOf(name), 0, 0.02 * came) << name;
}

TEST(MachineScene, ABlastThrowsWhatItSees) {
  const SceneRun run = ranTo("blast", 2, {{"courses", "6"}, {"bricks", "8"}});
  int thrown[2] = {0, 0};
  for (const PlacedBody& body : run.bodies()) {
    if (body.role != BodyRole::brick) continue;
    const double way = length(run.world().state(body.id)->position - body.def.position);
    thrown[body.name.starts_with("right")] += way > 0.3;
  }
  EXPECT_GT(thrown[1], 20);
  EXPECT_LT(thrown[0], thrown[1]);
}

}  // namespace
}  // namespace brickfall
