// Time: what is due by the clock is stepped, at any speed by the same step; frames that blend; what views ask for.
#include "unit/viewer/viewer_support.h"

namespace brickfall::viewer {
namespace {

constexpr double kDt = 1.0 / 60;

TEST(Session, ShowsAnEmptyFrameBeforeAnythingIsOpen) {
  TestSession t;
  ASSERT_NE(t.frame(), nullptr);
  EXPECT_EQ(t.frame()->info->kind, RunKind::nothing);
  EXPECT_TRUE(t.frame()->bodies.empty());
  EXPECT_FALSE(t.does(viewer::Run{}));
  EXPECT_NE(t.result.message.find("no scene"), std::string::npos) << t.result.message;
}

TEST(Session, StepsAsTheClockGoes) {
  TestSession t(kCubes, true);
  EXPECT_EQ(t.frame()->info->kind, RunKind::live);
  EXPECT_EQ(t.frame()->status.step, 0u);
  t.pass(0.5);
  EXPECT_NEAR(t.frame()->status.time, 0.5, kDt);
  EXPECT_NEAR(t.body("high").linearVelocity.y, -9.81 * t.frame()->status.time, 1e-6);
  t.does(Pause{});
  const std::uint64_t step = t.frame()->status.step;
  t.pass(1);
  EXPECT_EQ(t.frame()->status.step, step);
  EXPECT_FALSE(t.frame()->status.running);
}

TEST(Session, SlowMotionAndFastForwardKeepTheStep) {
  TestSession slow(kCubes, true), fast(kCubes, true), plain(kCubes, true);
  ASSERT_TRUE(slow.does(SetSpeed{0.1}));
  ASSERT_TRUE(fast.does(SetSpeed{4}));
  plain.pass(0.2);
  slow.pass(2);
  fast.pass(0.05);
  EXPECT_NEAR(double(slow.frame()->status.step), 12, 1);
  EXPECT_NEAR(double(fast.frame()->status.step), 12, 1);
  for (TestSession* t : {&slow, &fast, &plain}) {
    t->does(Pause{});
    while (t->frame()->status.step < 14) t->does(Step{1});
  }
  EXPECT_EQ(stateOf(*slow.frame()), stateOf(*plain.frame()));
  EXPECT_EQ(stateOf(*fast.frame()), stateOf(*plain.frame()));
  EXPECT_FALSE(slow.does(SetSpeed{0}));
  EXPECT_FALSE(slow.does(SetSpeed{std::nan("")}));
}

TEST(Session, SingleStepsPause) {
  TestSession t(kCubes, true);
  ASSERT_TRUE(t.does(Step{3}));
  EXPECT_EQ(t.frame()->status.step, 3u);
  EXPECT_FALSE(t.frame()->status.running);
  const std::string third = stateOf(*t.frame());
  ASSERT_TRUE(t.does(Step{2}));
  ASSERT_TRUE(t.does(Step{-2}));
  EXPECT_EQ(t.frame()->status.step, 3u);
  EXPECT_EQ(stateOf(*t.frame()), third);
  EXPECT_FALSE(t.does(Step{0}));
  EXPECT_FALSE(t.does(Step{-100}));
}

// A gap in the clock (the machine slept) is not made up for by hundreds of steps.
TEST(Session, LetsGoWhatCanNotBeKeptUpWith) {
  TestSession t(kCubes, true);
  t.pass(0.1);
  const std::uint64_t before = t.frame()->status.step;
  t.clock += 3600;
  t.session.pump();
  EXPECT_LE(t.frame()->status.step, before + 8);
  t.session.pump();
  EXPECT_LE(t.frame()->status.step, before + 8);
}

TEST(Session, FramesBlendFromWhereTheLastOneEnded) {
  TestSession t(kCubes, true);
  t.pass(0.1);
  std::shared_ptr<const Frame> first = t.frame(), second = first;
  for (int i = 0; i < 20 && second == first; i++) {
    t.pass(1.0 / 240);
    second = t.frame();
  }
  const int place = first->list->find(t.serialOf("high"));
  const FrameBody &was = first->bodies[std::size_t(place)], &is = second->bodies[std::size_t(place)];
  EXPECT_EQ(is.before.position, was.pose.position);
  EXPECT_NEAR(second->shownFor, kDt, 1e-3);
  EXPECT_EQ(blendAt(*second, second->madeAt), 0);
  EXPECT_EQ(blendAt(*second, second->madeAt + 1), 1);
  const Transform half = poseAt(is, blendAt(*second, second->madeAt + second->shownFor / 2));
  EXPECT_NEAR(half.position.y, (was.pose.position.y + is.pose.position.y) / 2, 1e-9);
}

TEST(Session, GathersOnlyWhatIsAskedFor) {
  TestSession t(kWall, true);
  t.pass(0.2);
  std::shared_ptr<const Frame> plain = t.frame();
  EXPECT_TRUE(plain->contacts.empty() && plain->bounds.empty() && plain->samples.empty());
  EXPECT_EQ(plain->islands, 0);
  EXPECT_FALSE(t.body("w/2/1").touching);
  t.does(Pause{});
  t.session.ask({true, true, true, true, true});
  t.session.pump();
  std::shared_ptr<const Frame> all = t.frame();
  EXPECT_GT(all->contacts.size(), 40u);
  EXPECT_EQ(all->bounds.size(), all->list->bodies.size());
  EXPECT_EQ(all->samples.size(), all->status.step);
  EXPECT_EQ(all->islands, 1);
  EXPECT_EQ(t.body("w/2/1").island, 0);
  EXPECT_EQ(t.body("ground").island, -1);
  EXPECT_TRUE(t.body("w/2/1").touching);
  EXPECT_GT(all->touchingPairs.size(), 20u);
  ASSERT_TRUE(all->report.has_value());
  EXPECT_EQ(all->report->islands, 1);
  // The whole wall's weight goes into the ground.
  double down = 0, weight = 0;
  const int ground = all->list->find(t.serialOf("ground"));
  for (const FrameContact& c : all->contacts)
    if (c.bodyA == ground || c.bodyB == ground) down += c.normalForce;
  for (const ListedBody& body : all->list->bodies) weight += body.mass * 9.81;
  EXPECT_NEAR(down, weight, 0.02 * weight);
}

TEST(Session, TellsTheNumbersOfTheSelectedBody) {
  TestSession t(kCubes, true);
  t.pass(0.3);
  ASSERT_TRUE(t.does(Select{t.serialOf("low")}));
  t.pass(0.1);
  ASSERT_TRUE(t.frame()->selected.has_value());
  const SelectedBody& low = *t.frame()->selected;
  EXPECT_EQ(low.name, "low");
  EXPECT_EQ(low.material, "wood");
  EXPECT_NEAR(low.mass, 600 * 0.008, 1e-9);
  double up = 0;
  ASSERT_TRUE(low.contacts && low.kineticEnergy && low.acceleration);
  for (const SelectedContact& c : *low.contacts) {
    EXPECT_EQ(c.otherName, "ground");
    EXPECT_NEAR(c.normal.y, 1, 1e-9);
    up += c.normalForce;
  }
  EXPECT_NEAR(up, low.mass * 9.81, 0.01 * low.mass * 9.81);
  ASSERT_TRUE(t.does(Select{t.serialOf("high")}));
  t.does(Pause{});
  EXPECT_NEAR(t.frame()->selected->acceleration->y, -9.81, 1e-6);
  EXPECT_NEAR(*t.frame()->selected->kineticEnergy, 0.5 * 4.8 * std::pow(t.frame()->selected->speed, 2), 1e-6);
  ASSERT_TRUE(t.does(Select{0}));
  EXPECT_FALSE(t.frame()->selected.has_value());
}

// The session alone knows who is selected: a body that comes back is still it.
TEST(Session, WhatIsSelectedStaysSoWhileItIsAway) {
  TestSession t(kCubes, false);
  const Serial low = t.serialOf("low");
  ASSERT_TRUE(t.does(Select{low}));
  ASSERT_TRUE(t.does(RemoveBody{low}));
  EXPECT_FALSE(t.frame()->selected.has_value());
  ASSERT_TRUE(t.does(Undo{}));
  ASSERT_TRUE(t.frame()->selected.has_value());
  EXPECT_EQ(t.frame()->selected->serial, low);
}

TEST(Session, FallenBodiesAreHitAndSleepAndTheLogSaysSo) {
  TestSession t(kCubes, true);
  t.pass(0.7);
  EXPECT_LT(t.body("high").sinceHit, 0.2f);
  EXPECT_NEAR(t.body("high").hitSpeed, std::sqrt(2 * 9.81 * 1.9), 0.3);
  EXPECT_GT(t.body("low").sinceHit, 100.f);
  t.pass(2.5);
  EXPECT_EQ(t.body("high").activity, Activity::asleep);
  EXPECT_EQ(t.body("ground").activity, Activity::fixed);
  std::string all;
  std::uint64_t last = 0;
  for (const LogLine& line : *t.frame()->log) {
    EXPECT_GT(line.number, last);
    last = line.number;
    all += line.text + "\n";
  }
  EXPECT_NE(all.find("ground and high"), std::string::npos) << all;
  EXPECT_NE(all.find("fell asleep"), std::string::npos) << all;
}

TEST(Session, UnderTheReportsSystemCollidingBodiesAreKnown) {
  TestSession t(std::string(kWall) + "[world]\nmethod = \"report\"\n", true);
  EXPECT_TRUE(t.frame()->info->reportMethod);
  t.session.ask({false, true, false, false, false});
  t.pass(0.5);
  EXPECT_GT(t.frame()->touchingPairs.size(), 10u);
  EXPECT_TRUE(t.body("w/2/1").touching);
  EXPECT_FALSE(t.does(DragBegin{t.serialOf("w/2/1"), {}, 20}));
  EXPECT_NE(t.result.message.find("report's system"), std::string::npos);
}

TEST(Session, RestartsFromTheBeginningWithTheSettingsAsTheyAre) {
  TestSession t(kCubes, true);
  const std::string start = stateOf(*t.frame());
  ASSERT_TRUE(t.does(ChangeSetting{"gravity.y", -1.62}));
  ASSERT_TRUE(t.does(ShootBall{{{0, 3, 0}, {0, -1, 0}}, 0.1, 5, "steel"}));
  t.pass(0.5);
  ASSERT_TRUE(t.does(Restart{}));
  EXPECT_EQ(t.frame()->status.step, 0u);
  EXPECT_EQ(stateOf(*t.frame()), start);
  EXPECT_EQ(t.serialOf("shot 1"), 0u);
  t.pass(0.5);
  EXPECT_NEAR(t.body("high").linearVelocity.y, -1.62 * t.frame()->status.time, 1e-6);
}

}  // namespace
}  // namespace brickfall::viewer
