// A take played: the same frames as a live run's, scrubbed to any place.
#include "brickfall/take.h"
#include "unit/viewer/viewer_support.h"

namespace brickfall::viewer {
namespace {

// Two seconds of the wall with a ball that comes after half a second.
class Recorded : public testing::Test {
 protected:
  void SetUp() override {
    TestSession t(kWall, true);
    ASSERT_TRUE(t.does(StartRecording{take.path()}));
    t.pass(0.5);
    t.does(ShootBall{{{0.4, 0.2, 0.6}, {0, 0, -1}}, 0.06, 7, "steel"});
    t.pass(1.5);
    ASSERT_TRUE(t.does(StopRecording{}));
    brick = t.body("w/4/1").pose;
  }
  TempFile take{"played.take"};
  Transform brick;
};

TEST_F(Recorded, PlaysToItsEndAndStartsAgain) {
  TestSession t;
  ASSERT_TRUE(t.does(Open{take.path(), {}, true})) << t.result.message;
  EXPECT_EQ(t.frame()->info->kind, RunKind::take);
  EXPECT_EQ(t.frame()->info->title, "A small wall");
  EXPECT_EQ(t.serialOf("shot 1"), 0u);
  EXPECT_EQ(t.frame()->list->bodies.back().material, "brick");
  t.pass(1);
  EXPECT_NEAR(t.frame()->status.time, 1, 0.03);
  EXPECT_NE(t.serialOf("shot 1"), 0u);
  t.pass(2);
  EXPECT_FALSE(t.frame()->status.running);
  EXPECT_EQ(t.frame()->status.time, t.frame()->status.latest);
  EXPECT_NEAR(length(t.body("w/4/1").pose.position - brick.position), 0, 1e-3);
  ASSERT_TRUE(t.does(viewer::Run{}));
  t.pass(0.1);
  EXPECT_LT(t.frame()->status.time, 0.2);
}

TEST_F(Recorded, SeeksAndStepsEitherWay) {
  TestSession t;
  ASSERT_TRUE(t.does(Open{take.path(), {}, false}));
  ASSERT_TRUE(t.does(Rewind{1}));
  const std::string there = stateOf(*t.frame());
  const std::uint64_t at = t.frame()->status.step;
  EXPECT_NEAR(t.frame()->status.time, 1, 0.02);
  ASSERT_TRUE(t.does(Step{10}));
  EXPECT_EQ(t.frame()->status.step, at + 10);
  ASSERT_TRUE(t.does(Step{-10}));
  EXPECT_EQ(t.frame()->status.step, at);
  EXPECT_EQ(stateOf(*t.frame()), there);
  ASSERT_TRUE(t.does(Step{-900}));
  EXPECT_EQ(t.frame()->status.step, 0u);
  ASSERT_TRUE(t.does(Rewind{1e6}));
  EXPECT_EQ(t.frame()->status.time, t.frame()->status.latest);
  EXPECT_FALSE(t.does(Rewind{std::nan("")}));
}

TEST_F(Recorded, KnowsSpeedsForcesAndHits) {
  TestSession t;
  ASSERT_TRUE(t.does(Open{take.path(), {}, false}));
  t.session.ask({false, true, false, false, false});
  ASSERT_TRUE(t.does(Rewind{0.5}));
  while (t.serialOf("shot 1") == 0 && t.frame()->status.step < 60) t.does(Step{1});
  t.does(Step{1});
  EXPECT_NEAR(t.body("shot 1").linearVelocity.z, -7, 0.1);
  EXPECT_GT(t.body("w/0/1").contactForce, 10);
  EXPECT_TRUE(t.body("w/0/1").touching);
  ASSERT_TRUE(t.does(Step{12}));
  EXPECT_LT(t.body("shot 1").sinceHit, 0.3f);
  ASSERT_TRUE(t.does(Select{t.serialOf("shot 1")}));
  EXPECT_EQ(t.frame()->selected->name, "shot 1");
}

TEST_F(Recorded, ShowsNothingThatItDoesNotKnow) {
  TestSession t;
  ASSERT_TRUE(t.does(Open{take.path(), {}, false}));
  ASSERT_TRUE(t.does(Rewind{1.9}));
  ASSERT_TRUE(t.does(Select{t.serialOf("w/0/1")}));
  ASSERT_TRUE(t.frame()->selected.has_value());
  const SelectedBody shown = *t.frame()->selected;
  EXPECT_FALSE(shown.kineticEnergy || shown.acceleration || shown.contacts);
  EXPECT_EQ(shown.material, "brick");
  ASSERT_TRUE(shown.contactForce.has_value());
  EXPECT_GT(*shown.contactForce, 10);
}

// Frames that lie nearer to each other than the header says: each counts by its own time.
TEST(Take, OfAChangedTimeStepGoesByItsFrames) {
  TempFile take("changed.take");
  TestSession live(kWall, false);
  ASSERT_TRUE(live.does(StartRecording{take.path()}));
  live.does(Step{30});
  ASSERT_TRUE(live.does(ChangeSetting{"timeStep", 1.0 / 20}));
  live.does(Step{20});
  ASSERT_TRUE(live.does(StopRecording{})) << live.result.message;
  const Result<TakeReader> read = TakeReader::open(take.path());
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read->frameCount(), 51u);
  ASSERT_NEAR(read->frame(50)->time, 1.5, 1e-9);

  TestSession t;
  ASSERT_TRUE(t.does(Open{take.path(), {}, false}));
  for (const std::size_t frame : {3u, 29u, 30u, 31u, 44u, 49u}) {
    ASSERT_TRUE(t.does(Rewind{read->frame(frame)->time}));
    EXPECT_EQ(t.frame()->status.step, frame);
    ASSERT_TRUE(t.does(Rewind{read->frame(frame)->time + 0.01}));
    EXPECT_EQ(t.frame()->status.step, frame);
    ASSERT_TRUE(t.does(Step{-1}));
    EXPECT_EQ(t.frame()->status.step, frame - 1);
    ASSERT_TRUE(t.does(Step{1}));
    EXPECT_EQ(t.frame()->status.step, frame);
  }
  // A second of the clock is a second of the take.
  ASSERT_TRUE(t.does(Rewind{0}));
  ASSERT_TRUE(t.does(viewer::Run{}));
  t.pass(1);
  EXPECT_NEAR(t.frame()->status.time, 1, 0.06);
}

// Live and played: joints for their view, layers of mortar that are drawn, and why a brick fell.
TEST(Take, TellsOfMortarAsTheRunDid) {
  const std::string wall = std::string(kWall) + R"(
[[mortar_kind]]
name = "weak"
tension = 5e3
cohesion = 1e4
tension_energy = 1
shear_energy = 5
)";
  std::string scene = wall;
  scene.replace(scene.find("courses = 5"), 11, "mortar = \"weak\"\nhead_joint = 0.01\nbed_joint = 0.01\ncourses = 5");
  TempFile take{"mortar.take"};
  FrameNeeds needs;
  needs.mortar = true;
  std::size_t joints = 0;
  {
    TestSession t(scene.c_str(), true);
    t.session.ask(needs);
    ASSERT_TRUE(t.does(StartRecording{take.path()}));
    t.pass(0.2);
    joints = t.frame()->mortar.size();
    EXPECT_GT(joints, 20u);
    const ListedBody& brick = t.frame()->list->bodies[std::size_t(t.frame()->list->find(t.serialOf("w/4/1")))];
    EXPECT_EQ(brick.shapes.size(), 1u);
    EXPECT_GT(brick.drawn.size(), 1u) << "with its mortar";
    EXPECT_EQ(brick.drawnMaterials.back(), "mortar");
    t.does(ShootBall{{{0.4, 0.34, 0.6}, {0, 0, -1}}, 0.06, 15, "steel"});
    t.pass(1);
    t.does(Select{t.serialOf("w/4/1")});
    t.pass(0.1);
    ASSERT_TRUE(t.frame()->selected);
    EXPECT_FALSE(t.frame()->selected->mortar.empty());
    ASSERT_TRUE(t.does(StopRecording{}));
  }
  TestSession t;
  ASSERT_TRUE(t.does(Open{take.path(), {}, false}));
  t.session.ask(needs);
  ASSERT_TRUE(t.does(Rewind{1.2}));
  EXPECT_EQ(t.frame()->mortar.size(), joints);
  int broken = 0, told = 0;
  for (const FrameMortar& joint : t.frame()->mortar) broken += joint.damage >= 1;
  EXPECT_GT(broken, 0);
  for (const ListedBody& body : t.frame()->list->bodies) {
    t.does(Select{body.serial});
    if (!t.frame()->selected) continue;
    for (const std::string& line : t.frame()->selected->mortar) told += line.find("Why it fell: ") == 0;
  }
  EXPECT_GT(told, 0);
}

TEST_F(Recorded, RefusesWhatNeedsAScene) {
  TestSession t;
  ASSERT_TRUE(t.does(Open{take.path(), {}, false}));
  EXPECT_FALSE(t.does(ShootBall{{{0, 1, 1}, {0, 0, -1}}, 0.1, 5, "steel"}));
  EXPECT_NE(t.result.message.find("take"), std::string::npos) << t.result.message;
  EXPECT_FALSE(t.does(Undo{}));
  EXPECT_FALSE(t.does(ChangeSetting{"gravity.y", 0}));
  EXPECT_TRUE(t.does(Restart{}));
}

}  // namespace
}  // namespace brickfall::viewer
