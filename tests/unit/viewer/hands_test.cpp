// Hands: balls, the spring, removing and waking; the tools that make these commands of a mouse.
#include "unit/viewer/viewer_support.h"
#include "viewer_core/drag_spring.h"
#include "viewer_core/tools.h"

namespace brickfall::viewer {
namespace {

TEST(Hands, ABallFliesAlongItsRay) {
  TestSession t(kWall, false);
  ASSERT_TRUE(t.does(ShootBall{{{0.4, 2, 5}, {0, 0, -2}}, 0.1, 12, "steel"})) << t.result.message;
  const FrameBody& ball = t.body("shot 1");
  EXPECT_EQ(ball.linearVelocity, (Vec3{0, 0, -12}));
  const ListedBody listed = t.frame()->list->bodies.back();
  EXPECT_EQ(listed.role, BodyRole::ball);
  EXPECT_EQ(listed.material, "steel");
  EXPECT_NEAR(listed.mass, 7850 * 4.0 / 3 * 3.14159265358979 * 0.001, 0.5);
  EXPECT_NEAR(listed.radius, 0.1 * std::sqrt(3.0), 1e-9);
  ASSERT_TRUE(t.does(ShootBall{{{0.4, 2, 5}, {0, 0, -1}}, 0.1, 12, "rubber"}));
  EXPECT_NE(t.serialOf("shot 2"), 0u);
  EXPECT_EQ(t.frame()->status.undo, "the ball");
}

TEST(Hands, RefuseWhatMakesNoSenseAndSayWhy) {
  TestSession t(kWall, false);
  const auto refused = [&](Command command, const std::string& word) {
    EXPECT_FALSE(t.does(std::move(command))) << word;
    EXPECT_NE(t.result.message.find(word), std::string::npos) << t.result.message;
  };
  const Ray ray{{0, 1, 3}, {0, 0, -1}};
  refused(ShootBall{ray, 0, 5, "steel"}, "radius");
  refused(ShootBall{ray, 1e6, 5, "steel"}, "radius");
  refused(ShootBall{ray, 0.1, -5, "steel"}, "speed");
  refused(ShootBall{ray, 0.1, 1e9, "steel"}, "elocity");
  refused(ShootBall{ray, 0.1, 5, "cheese"}, "cheese");
  refused(ShootBall{{{0, 1, 3}, {0, 0, 0}}, 0.1, 5, "steel"}, "direction");
  refused(ShootBall{{{std::nan(""), 1, 3}, {0, 0, 1}}, 0.1, 5, "steel"}, "position");
  refused(DragBegin{t.serialOf("ground"), {}, 20}, "fixed");
  refused(DragBegin{t.serialOf("w/0/0"), {}, 0}, "strength");
  refused(DragBegin{9999, {}, 20}, "gone");
  refused(DragMove{{0, 1, 0}}, "nothing is held");
  refused(RemoveBody{9999}, "gone");
  refused(WakeBody{9999}, "gone");
  EXPECT_EQ(t.frame()->status.undo, "");
  bool logged = false;
  for (const LogLine& line : *t.frame()->log) logged = logged || line.text.find("cheese") != std::string::npos;
  EXPECT_TRUE(logged);
}

// Held by a corner it comes to hang below the target, no overshoot by more than a little, and no swinging for ever.
TEST(Hands, TheSpringBringsABodyToItsTarget) {
  TestSession t(kCubes, true);
  t.pass(0.3);
  ASSERT_TRUE(t.does(DragBegin{t.serialOf("low"), {0.1, 0.1, 0.1}, 20})) << t.result.message;
  ASSERT_TRUE(t.does(DragMove{{0, 1.5, 0.5}}));
  double highest = 0;
  for (int i = 0; i < 60; i++) {
    t.pass(1.0 / 60);
    ASSERT_TRUE(t.frame()->drag.has_value());
    highest = std::max(highest, t.frame()->drag->grabbed.y);
  }
  EXPECT_LT(highest, 1.6);
  t.pass(3);
  const FrameDrag drag = *t.frame()->drag;
  // The spring gives way under the weight: g / w^2, and what is implicit in the step.
  EXPECT_NEAR(drag.grabbed.y, 1.5 - 9.81 / (14 * 14) * (1 + 2 * 14.0 / 60 + 14 * 14 / 3600.0), 0.01);
  EXPECT_NEAR(drag.grabbed.x, 0, 0.02);
  EXPECT_NEAR(drag.grabbed.z, 0.5, 0.02);
  EXPECT_NEAR(drag.force, 4.8 * 9.81, 3);
  EXPECT_LT(length(t.body("low").angularVelocity), 0.3);
  ASSERT_TRUE(t.does(DragEnd{}));
  t.pass(0.1);
  EXPECT_FALSE(t.frame()->drag.has_value());
  EXPECT_LT(t.body("low").linearVelocity.y, -0.5);
}

TEST(Hands, TheSpringIsNeverHarderThanItsLimit) {
  TestSession t(kCubes, true);
  t.pass(0.3);
  ASSERT_TRUE(t.does(DragBegin{t.serialOf("low"), {0, 0.1, 0}, 2}));
  ASSERT_TRUE(t.does(DragMove{{0, 900, 0}}));
  t.pass(0.5);
  EXPECT_NEAR(t.frame()->drag->force, 2 * 4.8 * 9.81, 1e-6);
  EXPECT_NEAR(t.body("low").linearVelocity.y, 9.81 * 0.5, 0.5);
}

TEST(Hands, WhatIsDraggedMayBeRemoved) {
  TestSession t(kCubes, true);
  ASSERT_TRUE(t.does(DragBegin{t.serialOf("low"), {}, 20}));
  ASSERT_TRUE(t.does(RemoveBody{t.serialOf("low")}));
  t.pass(0.1);
  EXPECT_FALSE(t.frame()->drag.has_value());
  EXPECT_EQ(t.serialOf("low"), 0u);
  ASSERT_TRUE(t.does(Undo{}));
  EXPECT_NE(t.serialOf("low"), 0u);
}

TEST(Hands, WakeOneAndAll) {
  TestSession t(kCubes, true);
  t.pass(4);
  t.does(Pause{});
  ASSERT_EQ(t.body("high").activity, Activity::asleep);
  ASSERT_TRUE(t.does(WakeBody{t.serialOf("low")}));
  EXPECT_EQ(t.body("low").activity, Activity::awake);
  EXPECT_EQ(t.body("high").activity, Activity::asleep);
  ASSERT_TRUE(t.does(WakeBody{}));
  EXPECT_EQ(t.body("high").activity, Activity::awake);
}

TEST(Hands, ABodyThatWaitsForItsLaunchIsHeld) {
  TestSession t("[[ball]]\nname = \"b\"\nposition = [0, 1, 0]\nvelocity = [1, 0, 0]\nlaunch_time = 0.2\n", true);
  EXPECT_EQ(t.body("b").activity, Activity::held);
  EXPECT_GT(t.frame()->list->bodies.back().mass, 1);
  t.pass(0.5);
  EXPECT_EQ(t.body("b").activity, Activity::awake);
}

TEST(Hands, ABlastPushesACutFreesTheGroundTiltsAndIsJerked) {
  TestSession t(
      "[[body]]\nname = \"hung\"\nsize = [0.2, 0.2, 0.2]\nposition = [0, 2, 0]\n[[body]]\nname = \"box\"\nsize = [0.2, "
      "0.2, "
      "0.2]\nposition = [3, 0.1, 0]\n[[joint]]\nbody_b = \"hung\"\nanchor = [0, 2.5, 0]\n",
      true);
  t.pass(0.5);
  EXPECT_NEAR(t.body("hung").pose.position.y, 2, 0.01);
  EXPECT_FALSE(t.does(CutJoints{t.serialOf("box")}));
  ASSERT_TRUE(t.does(CutJoints{t.serialOf("hung")}));
  EXPECT_FALSE(t.does(CutJoints{t.serialOf("hung")}));
  t.pass(0.3);
  EXPECT_LT(t.body("hung").pose.position.y, 1.8);
  ASSERT_TRUE(t.does(Explode{{2.5, 0.3, 0}, 300, 2}));
  EXPECT_FALSE(t.does(Explode{{2.5, 0.3, 0}, -1, 2}));
  t.pass(0.1);
  EXPECT_GT(t.body("box").pose.position.x, 3.002);
  ASSERT_TRUE(t.does(TiltGround{{0, 0, 1}, 10}));
  EXPECT_FALSE(t.does(TiltGround{{0, 0, 0}, 10}));
  ASSERT_TRUE(t.does(KickGround{{1, 0, 0}}));
  EXPECT_FALSE(t.does(KickGround{{1e9, 0, 0}}));
}

View frontView() {
  View view;
  view.position = {0, 1, 5};
  return view;
}

TEST(Tools, EachMakesItsCommands) {
  Hand hand;
  const View view = frontView();
  const Ray ray{view.position, {0, 0, -1}};
  PickHit hit;
  hit.serial = 7;
  hit.point = {0, 1, 0};
  hit.local = {0.1, 0, 0};
  hand.tool = Tool::shoot;
  const auto shots = hand.press(ray, view, {});
  ASSERT_EQ(shots.size(), 1u);
  const ShootBall& shot = std::get<ShootBall>(shots[0]);
  EXPECT_NEAR(shot.ray.origin.z, 5 - 3 * hand.settings.ballRadius, 1e-12);
  EXPECT_EQ(shot.speed, hand.settings.ballSpeed);
  hand.tool = Tool::remove;
  EXPECT_TRUE(hand.press(ray, view, {}).empty());
  EXPECT_EQ(std::get<RemoveBody>(hand.press(ray, view, hit).at(0)).body, 7u);
  hand.tool = Tool::cut;
  EXPECT_EQ(std::get<CutJoints>(hand.press(ray, view, hit).at(0)).body, 7u);
  hand.tool = Tool::blast;
  EXPECT_TRUE(hand.press(ray, view, {}).empty());
  EXPECT_NEAR(std::get<Explode>(hand.press(ray, view, hit).at(0)).centre.z, hand.settings.ballRadius, 1e-12);
  EXPECT_LT(std::get<TiltGround>(hand.tilt(view, 1)).axis.z * -1.0, 0);
  const double first = std::get<KickGround>(hand.jerk(view)).velocity.x;
  EXPECT_EQ(std::get<KickGround>(hand.jerk(view)).velocity.x, -first);
  hand.tool = Tool::select;
  EXPECT_EQ(std::get<Select>(hand.press(ray, view, hit).at(0)).body, 7u);
  EXPECT_EQ(std::get<Select>(hand.press(ray, view, {}).at(0)).body, 0u);
}

// Across the view at the depth where it was grabbed, nearer and further by the wheel.
TEST(Tools, DraggingKeepsTheDepth) {
  Hand hand;
  hand.tool = Tool::drag;
  const View view = frontView();
  PickHit hit;
  hit.serial = 7;
  hit.point = {0, 1, 1};
  EXPECT_TRUE(hand.move({view.position, {0, 0, -1}}, view).empty());
  ASSERT_EQ(hand.press({view.position, {0, 0, -1}}, view, hit).size(), 3u);
  EXPECT_TRUE(hand.dragging());
  const Ray aside{view.position, normalized(Vec3{0.5, 0, -1})};
  Vec3 target = std::get<DragMove>(hand.move(aside, view).at(0)).target;
  EXPECT_NEAR(target.x, 2, 1e-12);
  EXPECT_NEAR(target.z, 1, 1e-12);
  target = std::get<DragMove>(hand.wheel(1, aside, view).at(0)).target;
  EXPECT_NEAR(target.z, 5 - 4 * 1.1, 1e-12);
  EXPECT_EQ(hand.release().size(), 1u);
  EXPECT_FALSE(hand.dragging());
  EXPECT_TRUE(hand.release().empty());
}

TEST(Tools, SizesAndSpeedsStayWithinTheirLimits) {
  ToolSettings s;
  for (int i = 0; i < 100; i++) growBall(s, 1.25), hastenBall(s, 1.25);
  EXPECT_EQ(s.ballRadius, kLargestBall);
  EXPECT_EQ(s.ballSpeed, kFastestBall);
  for (int i = 0; i < 100; i++) growBall(s, 0.8), hastenBall(s, 0.8);
  EXPECT_EQ(s.ballRadius, kLeastBall);
  EXPECT_GT(s.ballSpeed, 0);
  EXPECT_LT(s.ballSpeed, 1);
  hastenBall(s, 1.25);
  EXPECT_GT(s.ballSpeed, 0.5);
}

}  // namespace
}  // namespace brickfall::viewer
