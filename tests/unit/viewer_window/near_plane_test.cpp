#include "viewer_window/near_plane.h"

#include <gtest/gtest.h>

namespace brickfall::viewer {
namespace {

// A floor and a brick of 20 cm.
Frame floorAndBrick(ShapeType floor, Vec3 brickAt) {
  auto list = std::make_shared<BodyList>();
  list->bodies.resize(2);
  list->bodies[0].shapes.resize(1);
  list->bodies[0].shapes[0].type = floor;
  list->bodies[0].shapes[0].halfExtents = {50, 1, 50};
  list->bodies[1].radius = 0.2;
  Frame frame;
  frame.list = std::move(list);
  frame.bodies.resize(2);
  frame.bodies[0].activity = Activity::fixed;
  if (floor == ShapeType::box) frame.bodies[0].pose.position = {0, -1, 0};
  frame.bodies[1].pose.position = frame.bodies[1].before.position = brickAt;
  return frame;
}

TEST(NearPlane, liesBeforeWhateverIsNearest) {
  for (const ShapeType floor : {ShapeType::plane, ShapeType::box}) {
    const Frame frame = floorAndBrick(floor, {0, 0.1, -30});
    const double high = nearPlaneOf(frame, 1, {0, 10, 0});
    EXPECT_GT(high, 1);
    EXPECT_LT(high, 5) << "half of the height: the picture's lower edge looks down by less than 60 degrees";
    EXPECT_NEAR(nearPlaneOf(frame, 1, {0, 1, 0}), high / 10, 1e-9);
    EXPECT_EQ(nearPlaneOf(frame, 1, {0, 0.01, 0}), kLeastNear);
    EXPECT_LT(nearPlaneOf(frame, 1, {0, 10, -30}), high) << "the brick is a little nearer than the floor";
    EXPECT_EQ(nearPlaneOf(frame, 1, {0, 0.3, -30}), kLeastNear);
  }
}

// A brick that comes past between two frames.
TEST(NearPlane, goesByWhatIsDrawn) {
  Frame frame = floorAndBrick(ShapeType::plane, {0, 10, 20});
  frame.bodies[1].before.position = {0, 10, -20};
  EXPECT_GT(nearPlaneOf(frame, 0, {0, 10, 0}), 1);
  EXPECT_EQ(nearPlaneOf(frame, 0.5, {0, 10, 0}), kLeastNear);
}

}  // namespace
}  // namespace brickfall::viewer
