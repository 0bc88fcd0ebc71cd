// What is under the mouse: of every kind of shape, where it is drawn, in scenes that run and in lists that change.
#include "viewer_core/picking.h"
#include "unit/viewer/viewer_support.h"

namespace brickfall::viewer {
namespace {

const Ray kAlong{{0, 0, 10}, {0, 0, -1}};

Frame frameOf(const std::vector<ShapeDef>& shapes) {
  Frame frame;
  auto list = std::make_shared<BodyList>();
  for (std::size_t i = 0; i < shapes.size(); i++) {
    ListedBody body;
    body.serial = Serial(10 + i);
    body.shapes = {shapes[i]};
    list->bodies.push_back(body);
    FrameBody place;
    place.pose.position = place.before.position = {double(3 * i), 0, 0};
    frame.bodies.push_back(place);
  }
  frame.list = list;
  return frame;
}

TEST(Picking, FindsEveryKindOfShape) {
  std::vector<ShapeDef> shapes(5);
  shapes[0].halfExtents = {0.5, 0.5, 0.5};
  shapes[1].type = ShapeType::sphere;
  shapes[2].type = ShapeType::capsule;
  shapes[3].type = ShapeType::hull;
  shapes[3].vertices = {{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 0.5}, {0, 0, -0.5}};
  shapes[4].type = ShapeType::plane;  // the floor
  const Frame frame = frameOf(shapes);
  Picker picker;
  for (int i = 0; i < 4; i++) {
    const auto hit = picker.pick(frame, {{3.0 * i, 0.01, 10}, {0, 0, -1}});
    ASSERT_TRUE(hit.has_value()) << i;
    EXPECT_EQ(hit->serial, Serial(10 + i));
    EXPECT_EQ(hit->place, i);
    EXPECT_NEAR(hit->point.z, 0.5, 0.02) << i;
    EXPECT_NEAR(hit->distance, 9.5, 0.02);
    EXPECT_GT(hit->normal.z, 0.5);
  }
  const auto floor = picker.pick(frame, {{-8, 5, 0}, {0, -1, 0}});
  ASSERT_TRUE(floor.has_value());
  EXPECT_EQ(floor->serial, 14u);
  EXPECT_FALSE(picker.pick(frame, {{-8, 5, 0}, {0, 1, 0}}).has_value());
  EXPECT_FALSE(picker.pick(frame, {{-8, 5, 0}, {0, 0, 0}}).has_value());
}

TEST(Picking, HitsWhereABodyIsDrawnAndGivesThePointInItsFrame) {
  Frame frame = frameOf({ShapeDef{}});
  frame.bodies[0].before.position = {0, 0, 0};
  frame.bodies[0].pose.position = {4, 0, 0};
  frame.bodies[0].pose.rotation = frame.bodies[0].before.rotation =
      quatFromAxisAngle(Vec3{0, 1, 0}, 3.14159265358979 / 2);
  Picker picker;
  EXPECT_TRUE(picker.pick(frame, kAlong, 0).has_value());
  EXPECT_FALSE(picker.pick(frame, kAlong, 0.5).has_value());
  EXPECT_FALSE(picker.pick(frame, kAlong, 1).has_value());
  const auto hit = picker.pick(frame, {{4.2, 0.1, 10}, {0, 0, -1}}, 1);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(length(hit->local - Vec3{-0.5, 0.1, 0.2}), 0, 1e-9);
}

TEST(Picking, FollowsListsThatChange) {
  TestSession t(kWall, false);
  Picker picker;
  const Ray ray{{0.4, 0.16, 3}, {0, 0, -1}};
  const auto first = picker.pick(*t.frame(), ray);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(t.frame()->list->bodies[std::size_t(first->place)].role, BodyRole::brick);
  ASSERT_TRUE(t.does(RemoveBody{first->serial}));
  const auto second = picker.pick(*t.frame(), ray);
  EXPECT_TRUE(!second || second->serial != first->serial);
  ASSERT_TRUE(t.does(ShootBall{{{0.4, 0.16, 2}, {0, 0, -1}}, 0.1, 0, "steel"}));
  const auto third = picker.pick(*t.frame(), ray);
  ASSERT_TRUE(third.has_value());
  EXPECT_EQ(third->serial, t.serialOf("shot 1"));
  ASSERT_TRUE(t.does(Undo{}));
  ASSERT_TRUE(t.does(Undo{}));
  EXPECT_EQ(picker.pick(*t.frame(), ray)->serial, first->serial);
  EXPECT_FALSE(picker.pick(*TestSession().frame(), ray).has_value());
}

TEST(Picking, BodiesFarAwayAreLeftOut) {
  Frame frame = frameOf({ShapeDef{}, ShapeDef{}});
  frame.bodies[1].pose.position = {1e9, 0, 0};
  Picker picker;
  EXPECT_TRUE(picker.pick(frame, kAlong).has_value());
  EXPECT_FALSE(picker.pick(frame, {{3, 0, 10}, {0, 0, -1}}).has_value());
  frame.bodies[1].pose.position = {3, 0, 0};
  EXPECT_TRUE(picker.pick(frame, {{3, 0, 10}, {0, 0, -1}}).has_value());
}

}  // namespace
}  // namespace brickfall::viewer
