// Undoing and rewinding: bit for bit, with commands in between; bounded in time and memory.
#include <thread>

#include "unit/viewer/viewer_support.h"
#include "viewer_core/live_run.h"
#include "viewer_core/opening.h"

namespace brickfall::viewer {
namespace {

// A live run by itself, for its state hash.
struct Lone {
  Serial serials = 1;
  EventLog log;
  std::unique_ptr<LiveRun> run;

  explicit Lone(const std::string& scene, const HistoryLimits& limits = {}) {
    SceneLoad load = parseScene(scene, "test.toml");
    EXPECT_TRUE(load.scene.has_value());
    Result<std::unique_ptr<LiveRun>> made = LiveRun::start({"test.toml", scene, {}}, *load.scene, limits, serials, log);
    EXPECT_TRUE(made.ok());
    run = std::move(*made);
  }
  std::uint64_t hash() const { return run->run().world().stateHash(); }
  std::uint64_t step() const { return run->run().stepCount(); }
  Serial serialOf(const std::string& name) const {
    for (const ListedBody& body : run->list()->bodies)
      if (body.name == name) return body.serial;
    return 0;
  }
  bool does(const Command& command) {
    const Result<std::string> answer = run->execute(command);
    EXPECT_TRUE(answer.ok()) << (answer ? "" : answer.error().message);
    return answer.ok();
  }
  // What a user does in the first seconds, by step.
  void act() {
    switch (step()) {
      case 10:
        does(ShootBall{{{0.4, 0.2, 1}, {0, 0, -1}}, 0.06, 7, "steel"});
        break;
      case 40:
        does(DragBegin{serialOf("w/4/1"), {0.05, 0, 0}, 30});
        break;
      case 41:
        does(DragMove{{0.5, 0.8, 0.3}});
        break;
      case 60:
        does(DragMove{{0.1, 0.9, 0.2}});
        break;
      case 75:
        does(ChangeSetting{"gravity.y", -5});
        break;
      case 76:
        does(DragEnd{});
        break;
      case 90:
        does(RemoveBody{serialOf("w/0/2")});
        break;
      case 100:
        does(ChangeMaterial{"brick", 1500, 0.3, 0.2});
        break;
      case 110:
        does(ChangeSetting{"substeps", 2});
        break;
      case 120:
        does(ChangeSetting{"restingStiffness", 500});
        break;
      case 124:
        does(Explode{{0.4, 0.3, 0.5}, 30, 2});
        break;
      case 126:
        does(TiltGround{{0, 0, 1}, 3});
        break;
      case 128:
        does(KickGround{{0.2, 0, 0.1}});
        break;
      case 130:
        does(ShootBall{{{0.3, 0.3, 1}, {0, 0, -1}}, 0.05, 9, "rubber"});
        break;
      case 131:
        does(WakeBody{0});
        break;
      case 140:
        does(ChangeSetting{"timeStep", 1.0 / 120});
        break;
    }
  }
};

constexpr int kSteps = 200;

// Every fifth step is gone back to: its hash is what it was, and from there on all hashes come again, with the same commands.
TEST(Rewind, IsTheSameBitForBitAndGoesOnSo) {
  HistoryLimits limits;
  limits.interval = 0.5;
  Lone lone(kWall, limits);
  std::vector<std::uint64_t> hashes;
  std::vector<double> times;
  for (int i = 0; i < kSteps; i++) {
    hashes.push_back(lone.hash());
    times.push_back(lone.run->run().time());
    lone.act();
    ASSERT_TRUE(lone.run->step().ok());
  }
  const std::uint64_t last = lone.hash();
  const double latest = lone.run->run().time();
  for (int to = kSteps - 1; to >= 0; to -= 5) {
    ASSERT_TRUE(lone.run->rewind(times[std::size_t(to)]).ok()) << to;
    ASSERT_EQ(lone.step(), std::uint64_t(to));
    ASSERT_EQ(lone.hash(), hashes[std::size_t(to)]) << "gone back to step " << to;
  }
  // Forward again, as long as nobody goes on from there.
  ASSERT_TRUE(lone.run->rewind(latest).ok());
  EXPECT_EQ(lone.hash(), last);
  for (int to : {131, 95, 41}) {
    ASSERT_TRUE(lone.run->rewind(times[std::size_t(to)]).ok());
    for (int i = to; i < kSteps; i++) {
      ASSERT_EQ(lone.hash(), hashes[std::size_t(i)]) << "gone on from step " << to << ", differs at " << i;
      lone.act();
      ASSERT_TRUE(lone.run->step().ok());
    }
    EXPECT_EQ(lone.hash(), last);
  }
}

TEST(Rewind, GoingOnForgetsWhatLayAhead) {
  Lone lone(kWall);
  for (int i = 0; i < 60; i++) ASSERT_TRUE(lone.run->step().ok());
  ASSERT_TRUE(lone.run->rewind(0.5).ok());
  EXPECT_NEAR(lone.run->history().latest(), 1, 1e-9);
  ASSERT_TRUE(lone.run->step().ok());
  EXPECT_NEAR(lone.run->history().latest(), 0.5 + 1.0 / 60, 1e-9);
  EXPECT_FALSE(lone.run->rewind(1).ok());
  EXPECT_FALSE(lone.run->rewind(-1).ok());
  EXPECT_FALSE(lone.run->rewind(std::nan("")).ok());
}

TEST(Rewind, ReachesBackAsFarAsAskedAndNoFurther) {
  HistoryLimits limits;
  limits.seconds = 2;
  limits.interval = 0.5;
  Lone lone(kWall, limits);
  for (int i = 0; i < 300; i++) ASSERT_TRUE(lone.run->step().ok());
  const History& history = lone.run->history();
  EXPECT_LE(history.earliest(), 3 + 1e-9);
  EXPECT_GE(history.earliest(), 2.4);
  const double earliest = history.earliest();
  EXPECT_FALSE(lone.run->rewind(earliest - 0.1).ok());
  ASSERT_TRUE(lone.run->rewind(earliest).ok());
  EXPECT_NEAR(lone.run->run().time(), earliest, 1e-9);
}

TEST(Rewind, MemoryIsBounded) {
  HistoryLimits limits;
  limits.interval = 0.1;
  limits.mostBytes = 150'000;
  Lone lone(kWall, limits);
  for (int i = 0; i < 200; i++) {
    if (i % 10 == 0) lone.does(ShootBall{{{0.4, 3.0 + i, 1}, {0, 1, 0}}, 0.05, 1, "steel"});
    ASSERT_TRUE(lone.run->step().ok());
    EXPECT_LE(lone.run->history().bytes(), limits.mostBytes);
  }
  EXPECT_GT(lone.run->history().earliest(), 0.5);
  ASSERT_TRUE(lone.run->rewind(lone.run->history().earliest()).ok());
}

Kept keptAt(std::uint64_t step, bool regular, std::string change = {}) {
  Kept kept;
  kept.moment.step = step;
  kept.time = double(step);
  kept.bytes = PackedBytes(std::vector<std::byte>(1000));
  while (kept.bytes.size() == 1000) std::this_thread::yield();  // until it is compressed
  kept.regular = regular;
  kept.change = std::move(change);
  return kept;
}

// Those that only save time go before any that rewinding needs.
TEST(Rewind, SpareSnapshotsMakeRoomFirst) {
  HistoryLimits limits;
  limits.mostBytes = 24 * keptAt(0, true).bytes.size();
  History history(limits);
  history.begin(0, 0);
  history.keep(keptAt(0, true));
  for (std::uint64_t step = 1; step < 29; step++) {
    history.stepped(double(step));
    history.keep(keptAt(step, step % 4 == 0));
  }
  EXPECT_LE(history.bytes(), limits.mostBytes / 2 + keptAt(0, true).bytes.size());
  EXPECT_EQ(history.earliest(), 0);
  for (std::uint64_t step = 0; step < 29; step++) {
    ASSERT_NE(history.before({step, 0}), nullptr);
    EXPECT_LE(step - history.before({step, 0})->moment.step, 3u);
  }
  EXPECT_EQ(history.before({27, 0})->moment.step, 27u);
}

TEST(Rewind, BodiesKeepTheirSerialsAndNewOnesGetNewOnes) {
  Lone lone(kWall);
  const Serial brick = lone.serialOf("w/2/1");
  lone.does(ShootBall{{{0, 2, 0}, {0, 1, 0}}, 0.05, 1, "steel"});
  const Serial first = lone.serialOf("shot 1");
  for (int i = 0; i < 10; i++) ASSERT_TRUE(lone.run->step().ok());
  ASSERT_TRUE(lone.run->rewind(0).ok());
  EXPECT_EQ(lone.serialOf("shot 1"), 0u);
  ASSERT_TRUE(lone.run->rewind(0.1).ok());
  EXPECT_EQ(lone.serialOf("shot 1"), first);
  EXPECT_EQ(lone.serialOf("w/2/1"), brick);
  ASSERT_TRUE(lone.run->rewind(0).ok());
  lone.does(ShootBall{{{0, 2, 0}, {0, 1, 0}}, 0.15, 1, "steel"});
  EXPECT_NE(lone.serialOf("shot 1"), first);
}

TEST(Undo, TakesBackOneChangeAfterTheOther) {
  Lone lone(kWall);
  std::vector<std::uint64_t> before;
  const auto change = [&](const Command& command) {
    before.push_back(lone.hash());
    lone.does(command);
    for (int i = 0; i < 20; i++) ASSERT_TRUE(lone.run->step().ok());
  };
  EXPECT_FALSE(lone.run->undo().ok());
  change(ShootBall{{{0.4, 0.2, 1}, {0, 0, -1}}, 0.06, 7, "steel"});
  change(RemoveBody{lone.serialOf("w/0/1")});
  change(ChangeSetting{"gravity.y", 3});
  change(ChangeMaterial{"brick", 1500, 0.3, 0.2});
  EXPECT_EQ(lone.run->undoLabel(), "material brick");
  for (auto hash = before.rbegin(); hash != before.rend(); ++hash) {
    ASSERT_TRUE(lone.run->undo().ok());
    EXPECT_EQ(lone.hash(), *hash);
  }
  EXPECT_EQ(lone.run->undoLabel(), "");
  EXPECT_FALSE(lone.run->undo().ok());
  EXPECT_EQ(lone.run->wanted().world.gravity.y, -9.81);
  EXPECT_EQ(lone.serialOf("shot 1"), 0u);
  EXPECT_NE(lone.serialOf("w/0/1"), 0u);
}

TEST(Undo, OfASliderIsOneAndAFailedChangeIsNone) {
  Lone lone(kWall);
  for (double g : {-9.0, -8.0, -7.0}) lone.does(ChangeSetting{"gravity.y", g});
  EXPECT_FALSE(lone.run->execute(ChangeSetting{"gravity.y", 1e9}).ok());
  EXPECT_FALSE(lone.run->execute(RemoveBody{12345}).ok());
  EXPECT_FALSE(lone.run->execute(ShootBall{{{0, 1, 0}, {0, 0, 1}}, 0.1, 5, "cheese"}).ok());
  ASSERT_TRUE(lone.run->undo().ok());
  EXPECT_EQ(lone.run->run().world().gravity().y, -9.81);
  EXPECT_FALSE(lone.run->undo().ok());
}

// Going back to where a ball was shot and on from there: the ball was not shot, and there is nothing to take back.
TEST(Undo, KnowsNoChangeThatWasCutOff) {
  Lone lone(kWall);
  for (int i = 0; i < 20; i++) ASSERT_TRUE(lone.run->step().ok());
  lone.does(ShootBall{{{0.4, 0.2, 1}, {0, 0, -1}}, 0.06, 7, "steel"});
  for (int i = 0; i < 20; i++) ASSERT_TRUE(lone.run->step().ok());
  ASSERT_TRUE(lone.run->stepBack(20).ok());
  ASSERT_EQ(lone.serialOf("shot 1"), 0u);
  ASSERT_TRUE(lone.run->step().ok());
  EXPECT_EQ(lone.run->undoLabel(), "");
  EXPECT_FALSE(lone.run->undo().ok());
  EXPECT_EQ(lone.step(), 21u);
  // A change at the same step as before is one again.
  ASSERT_TRUE(lone.run->stepBack(1).ok());
  const std::uint64_t before = lone.hash();
  lone.does(RemoveBody{lone.serialOf("w/0/1")});
  ASSERT_TRUE(lone.run->step().ok());
  EXPECT_EQ(lone.run->undoLabel(), "the removal");
  ASSERT_TRUE(lone.run->undo().ok());
  EXPECT_EQ(lone.hash(), before);
}

// A slider that is moved on after going back is a change of its own: what it did before lies ahead and is forgotten.
TEST(Undo, OfASliderBeginsAnewAfterGoingBack) {
  Lone lone(kWall);
  for (int i = 0; i < 10; i++) ASSERT_TRUE(lone.run->step().ok());
  lone.does(ChangeSetting{"gravity.y", -8});
  ASSERT_TRUE(lone.run->step().ok());
  ASSERT_TRUE(lone.run->stepBack(1).ok());
  lone.does(WakeBody{0});
  lone.does(ChangeSetting{"gravity.y", -7});
  EXPECT_EQ(lone.run->undoLabel(), "gravity.y");
  ASSERT_TRUE(lone.run->undo().ok());
  EXPECT_EQ(lone.run->run().world().gravity().y, -9.81);
}

// What is refused changes nothing, so what lies ahead after a rewind stays within reach.
TEST(Rewind, WhatIsRefusedForgetsNothing) {
  Lone lone(kWall);
  for (int i = 0; i < 60; i++) ASSERT_TRUE(lone.run->step().ok());
  const std::uint64_t last = lone.hash();
  ASSERT_TRUE(lone.run->rewind(0.5).ok());
  for (const Command& command :
       {Command(ShootBall{{{0, 1, 0}, {0, 0, 1}}, 0.1, 5, "cheese"}), Command(RemoveBody{12345}),
        Command(ChangeSetting{"gravity.y", 1e9}), Command(ChangeMaterial{"cheese", 1, 1, 1}),
        Command(StartRecording{"no/such/folder/x.take"})}) {
    EXPECT_FALSE(lone.run->execute(command).ok());
    EXPECT_EQ(lone.run->undoLabel(), "");
  }
  ASSERT_TRUE(lone.run->rewind(1).ok());
  EXPECT_EQ(lone.hash(), last);
}

TEST(Rewind, KeepsWhatWaitsForARestart) {
  Lone lone(kWall);
  lone.does(ChangeSetting{"maxBodies", 100});
  lone.does(ChangeSetting{"method", 1});
  for (int i = 0; i < 10; i++) ASSERT_TRUE(lone.run->step().ok());
  ASSERT_TRUE(lone.run->rewind(0).ok());
  EXPECT_EQ(lone.run->wanted().world.maxBodies, 100);
  EXPECT_EQ(lone.run->settingsWait(), 2u);
}

// A slider knows times as floats: half a minute on they are some microseconds off.
TEST(Rewind, TakesTimesThatAreALittleOff) {
  Lone lone(kWall);
  for (int i = 0; i < 30; i++) ASSERT_TRUE(lone.run->step().ok());
  ASSERT_TRUE(lone.run->rewind(lone.run->history().latest() + 1e-4).ok());
  EXPECT_EQ(lone.step(), 30u);
  ASSERT_TRUE(lone.run->rewind(lone.run->history().earliest() - 1e-4).ok());
  EXPECT_EQ(lone.step(), 0u);
}

// Longer ago than rewinding reaches.
TEST(Undo, ReachesBackFurtherThanRewinding) {
  HistoryLimits limits;
  limits.seconds = 0.5;
  limits.interval = 0.25;
  Lone lone(kWall, limits);
  for (int i = 0; i < 10; i++) ASSERT_TRUE(lone.run->step().ok());
  const std::uint64_t before = lone.hash();
  lone.does(RemoveBody{lone.serialOf("w/0/1")});
  for (int i = 0; i < 120; i++) ASSERT_TRUE(lone.run->step().ok());
  EXPECT_GT(lone.run->history().earliest(), 1);
  ASSERT_TRUE(lone.run->undo().ok());
  EXPECT_EQ(lone.hash(), before);
  EXPECT_EQ(lone.step(), 10u);
  for (int i = 0; i < 20; i++) ASSERT_TRUE(lone.run->step().ok());
  ASSERT_TRUE(lone.run->rewind(lone.run->history().earliest()).ok());
  EXPECT_EQ(lone.hash(), before);
}

TEST(Rewind, OfTheReportsSystemIsTheSameBitForBit) {
  Lone lone(std::string(kWall) +
            "[world]\nmethod = \"report\"\n[report]\nwarm_starting = true\nmanifold = true\nfriction = true\n");
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 90; i++) {
    if (i == 30) lone.does(ShootBall{{{0.4, 0.2, 1}, {0, 0, -1}}, 0.06, 7, "steel"});
    ASSERT_TRUE(lone.run->step().ok());
    hashes.push_back(lone.hash());
  }
  for (std::size_t to : {80u, 70u, 31u, 12u}) {
    ASSERT_TRUE(lone.run->rewind(double(to) / 60).ok());
    EXPECT_EQ(lone.hash(), hashes[to - 1]) << to;
  }
}

TEST(Rewind, ThroughASessionPausesAndSeeks) {
  TestSession t(kWall, true);
  t.pass(1.5);
  const std::shared_ptr<const Frame> before = t.frame();
  ASSERT_TRUE(t.does(Rewind{0.5}));
  EXPECT_FALSE(t.frame()->status.running);
  EXPECT_NEAR(t.frame()->status.time, 0.5, 1e-9);
  EXPECT_EQ(t.frame()->shownFor, 0);
  EXPECT_EQ(t.frame()->list, before->list);
  ASSERT_TRUE(t.does(Rewind{before->status.time}));
  EXPECT_EQ(stateOf(*t.frame()), stateOf(*before));
  EXPECT_FALSE(t.does(Rewind{99}));
}

}  // namespace
}  // namespace brickfall::viewer
