// The camera by itself: where it goes, how smoothly, and where it does not.
#include <gtest/gtest.h>

#include "viewer_core/camera_rig.h"

namespace brickfall::viewer {
namespace {

const Viewport kPort{1280, 720};

void settle(CameraRig& rig, const std::optional<Vec3>& target = {}) {
  for (int i = 0; i < 300; i++) rig.update(1.0 / 60, target);
}

void expectNear(Vec3 found, Vec3 wanted, double tolerance) {
  EXPECT_NEAR(length(found - wanted), 0, tolerance) << found.x << " " << found.y << " " << found.z;
}

Camera savedView() {
  Camera camera;
  camera.position = {3, 2, 4};
  camera.target = {0, 0.5, -1};
  camera.fieldOfViewDegrees = 40;
  return camera;
}

TEST(Camera, ASavedViewIsReachedSmoothlyAndWhole) {
  CameraRig rig;
  rig.goTo({"a", {0, 1, 5}, {0, 1, 0}, 45}, true);
  expectNear(rig.view().position, {0, 1, 5}, 1e-9);
  rig.goTo(savedView());
  expectNear(rig.view().position, {0, 1, 5}, 1e-9);
  rig.update(0.05);
  const double left = length(rig.view().position - Vec3{3, 2, 4});
  EXPECT_LT(left, length(Vec3{3, 1, -1}));
  EXPECT_GT(left, 0.1);
  settle(rig);
  const Camera reached = rig.asCamera();
  expectNear(reached.position, {3, 2, 4}, 1e-6);
  expectNear(reached.target, {0, 0.5, -1}, 1e-6);
  EXPECT_NEAR(reached.fieldOfViewDegrees, 40, 1e-6);
  expectNear(rig.view().forward(), normalized(Vec3{-3, -1.5, -5}), 1e-6);
}

// A long frame takes it as far as many short ones.
TEST(Camera, DoesNotDependOnTheFrameRate) {
  CameraRig coarse, fine;
  for (CameraRig* rig : {&coarse, &fine}) {
    rig->goTo({"a", {0, 1, 5}, {0, 1, 0}, 45}, true);
    rig->goTo(savedView());
  }
  coarse.update(0.1);
  for (int i = 0; i < 100; i++) fine.update(0.001);
  expectNear(coarse.view().position, fine.view().position, 1e-9);
}

TEST(Camera, RaysGoThroughTheirPixels) {
  CameraRig rig;
  rig.goTo(savedView(), true);
  const View view = rig.view();
  expectNear(rayThrough(view, kPort, 640, 360).direction, view.forward(), 1e-9);
  for (double x : {0.0, 300.0, 1280.0})
    for (double y : {0.0, 500.0, 720.0}) {
      const Ray ray = rayThrough(view, kPort, x, y);
      const std::optional<PixelPlace> back = pixelOf(view, kPort, ray.origin + ray.direction * 7.0);
      ASSERT_TRUE(back.has_value());
      EXPECT_NEAR(back->x, x, 1e-6);
      EXPECT_NEAR(back->y, y, 1e-6);
    }
  EXPECT_GT(dot(rayThrough(view, kPort, 1280, 360).direction, view.right()), 0);
  EXPECT_GT(dot(rayThrough(view, kPort, 640, 0).direction, view.up()), 0);
  EXPECT_FALSE(pixelOf(view, kPort, view.position - view.forward()).has_value());
}

TEST(Camera, OrbitsAtItsDistanceAndFliesAboutItsEye) {
  CameraRig rig;
  rig.goTo(savedView(), true);
  const double distance = rig.distance();
  rig.turn(0.7, -0.2);
  settle(rig);
  EXPECT_NEAR(rig.distance(), distance, 1e-9);
  expectNear(rig.target(), {0, 0.5, -1}, 1e-9);
  rig.setMode(CameraMode::fly);
  const Vec3 eye = rig.view().position;
  rig.turn(-0.4, 0.3);
  settle(rig);
  expectNear(rig.view().position, eye, 1e-6);
  const Vec3 ahead = rig.view().forward();
  rig.setFlySpeed(3);
  rig.move({0, 0, 1}, 0.5);
  settle(rig);
  expectNear(rig.view().position, eye + ahead * 1.5, 1e-6);
}

TEST(Camera, NeverGoesUnderTheGround) {
  for (CameraMode mode : {CameraMode::orbit, CameraMode::fly}) {
    CameraRig rig;
    rig.setMode(mode);
    rig.setGround(0);
    rig.goTo(savedView(), true);
    for (int i = 0; i < 400; i++) {
      rig.turn(0.05, i % 3 ? 0.1 : -0.05);
      rig.zoom(i % 5 ? -0.5 : 1);
      rig.move({0.2, -1, 0.3}, 1.0 / 60);
      rig.drag(3, -9, kPort);
      rig.update(1.0 / 60);
      ASSERT_GE(rig.view().position.y, 0.049) << i;
      ASSERT_LE(std::abs(rig.view().forward().y), 1.0);
    }
  }
}

TEST(Camera, FollowsAtADistanceByTheBodysSize) {
  CameraRig rig;
  rig.setGround(0);
  rig.goTo(savedView(), true);
  rig.follow(7, 0.1);
  EXPECT_EQ(rig.followed(), 7u);
  settle(rig, Vec3{1, 1, 1});
  expectNear(rig.target(), {1, 1, 1}, 1e-6);
  EXPECT_NEAR(rig.distance(), 0.1 * CameraRig::kFirstRadii, 1e-6);
  for (int i = 0; i < 50; i++) rig.zoom(1);
  settle(rig, Vec3{1, 1, 1});
  EXPECT_NEAR(rig.distance(), 0.1 * CameraRig::kNearestRadii, 1e-6);
  // A fast body stays in the middle.
  Vec3 at{1, 1, 1};
  for (int i = 0; i < 60; i++) {
    at += Vec3{0.1, 0, 0};
    rig.update(1.0 / 60, at);
    expectNear(rig.target(), at, 0.3);
  }
  rig.update(1.0 / 60);
  EXPECT_EQ(rig.mode(), CameraMode::orbit);
  EXPECT_EQ(rig.followed(), 0u);
}

TEST(Camera, OfASceneTurnsAfterABody) {
  BodyList list;
  list.bodies.resize(2);
  list.bodies[0].serial = 3, list.bodies[0].name = "wall";
  list.bodies[1].serial = 8, list.bodies[1].name = "ball";
  Camera camera{"side", {0, 1, 5}, {0, 1, 0}, 45};
  camera.follow = "ball";
  CameraRig rig;
  rig.goTo(camera, true, &list);
  EXPECT_EQ(rig.followed(), 8u);
  for (int i = 0; i < 90; i++) {  // over and past the eye
    const Vec3 at{-4 + 0.1 * i, 0.5, 6 - 0.1 * i};
    rig.update(1.0 / 60, at);
    expectNear(rig.view().position, camera.position, 1e-9);
    expectNear(rig.view().forward(), normalized(at - camera.position), 1e-9);
  }
  rig.turn(0.1, 0);
  EXPECT_EQ(rig.mode(), CameraMode::orbit) << "it is the user's now";
  EXPECT_EQ(rig.followed(), 0u);
  rig.goTo(camera, true, &list);
  rig.update(1.0 / 60);
  EXPECT_EQ(rig.mode(), CameraMode::orbit) << "the body is gone";
  camera.follow = "bal";
  rig.goTo(camera, true, &list);
  EXPECT_EQ(rig.followed(), 0u);
  expectNear(rig.target(), camera.target, 1e-12);
}

TEST(Camera, FramesAllOfABox) {
  const Aabb box{{-3, 0, -1}, {3, 2.5, 1}};
  for (Viewport port : {Viewport{1280, 720}, Viewport{400, 900}}) {
    CameraRig rig;
    rig.setGround(0);
    rig.goTo(savedView(), true);
    rig.frame(box, port, true);
    double widest = 0;
    for (int corner = 0; corner < 8; corner++) {
      const Vec3 point{corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                       corner & 4 ? box.upper.z : box.lower.z};
      const std::optional<PixelPlace> pixel = pixelOf(rig.view(), port, point);
      ASSERT_TRUE(pixel.has_value());
      EXPECT_GE(pixel->x, 0);
      EXPECT_LE(pixel->x, port.width);
      EXPECT_GE(pixel->y, 0);
      EXPECT_LE(pixel->y, port.height);
      widest = std::max(widest, std::abs(pixel->x - port.width / 2) / port.width);
    }
    EXPECT_GT(widest, 0.15);
  }
}

}  // namespace
}  // namespace brickfall::viewer
