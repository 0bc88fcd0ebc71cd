// The path of a camera: where it is between its keys.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "brickfall/scene.h"

namespace brickfall {
namespace {

Camera onPath() {
  Camera camera;
  camera.name = "dolly";
  camera.path = {{1, {0, 1, 4}, {0, 0, 0}, 40}, {2, {1, 1, 4}, {0, 1, 0}, 50}, {4, {4, 1, 2}, {0, 1, 0}, 30}};
  return camera;
}

TEST(CameraPath, PassesItsKeysAndStandsBeyondThem) {
  const Camera camera = onPath();
  for (const CameraKey& key : camera.path) {
    const Camera at = cameraAt(camera, key.time);
    EXPECT_LE(length(at.position - key.position), 1e-12);
    EXPECT_LE(length(at.target - key.target), 1e-12);
    EXPECT_NEAR(at.fieldOfViewDegrees, key.fieldOfViewDegrees, 1e-12);
    EXPECT_EQ(at.name, "dolly");
  }
  EXPECT_EQ(cameraAt(camera, -5).position, camera.path.front().position);
  EXPECT_EQ(cameraAt(camera, 99).position, camera.path.back().position);
}

TEST(CameraPath, WithoutKeysItStaysWhereItIs) {
  Camera camera;
  EXPECT_EQ(cameraAt(camera, 3).position, camera.position);
  camera.path = {{2, {9, 9, 9}, {}, 45}};
  EXPECT_EQ(cameraAt(camera, 0).position, (Vec3{9, 9, 9}));
}

// Speed is continuous everywhere, and none at both ends.
TEST(CameraPath, MovesWithoutAJerk) {
  const Camera camera = onPath();
  const double h = 1e-5;
  const auto speed = [&](double t) {
    return (cameraAt(camera, t + h).position - cameraAt(camera, t - h).position) * (0.5 / h);
  };
  EXPECT_LE(length(speed(1)), 1e-3);
  EXPECT_LE(length(speed(4)), 1e-3);
  for (double t = 1; t <= 4; t += 0.01) EXPECT_LE(length(speed(t + 2e-5) - speed(t - 2e-5)), 1e-3) << t;
  EXPECT_GT(length(speed(2)), 0.5) << "it does not stop at a key in between";
}

TEST(CameraPath, RestsBetweenEqualKeys) {
  Camera camera = onPath();
  camera.path.insert(camera.path.begin() + 2, {3, {1, 1, 4}, {0, 1, 0}, 50});
  for (double t = 2; t <= 3; t += 0.125) EXPECT_LE(length(cameraAt(camera, t).position - Vec3{1, 1, 4}), 1e-12) << t;
}

TEST(CameraPath, FaultsAreNamed) {
  EXPECT_EQ(cameraPathFault(onPath().path), "");
  const auto fault = [](auto spoil) {
    Camera camera = onPath();
    spoil(camera.path[1]);
    return cameraPathFault(camera.path);
  };
  EXPECT_NE(fault([](CameraKey& k) { k.time = 1; }).find("ascend"), std::string::npos);
  EXPECT_NE(fault([](CameraKey& k) { k.time = std::nan(""); }).find("time"), std::string::npos);
  EXPECT_NE(fault([](CameraKey& k) { k.target.x = std::numeric_limits<double>::infinity(); }).find("finite"),
            std::string::npos);
  EXPECT_NE(fault([](CameraKey& k) { k.target = k.position; }).find("target"), std::string::npos);
  EXPECT_NE(fault([](CameraKey& k) { k.fieldOfViewDegrees = 180; }).find("field of view"), std::string::npos);
}

TEST(CameraPath, IsReadFromTheSceneFile) {
  SceneLoad load = parseScene(
      "[[wall]]\n[[camera]]\nposition = [0, 1, 4]\ntarget = [0, 1, 0]\nfield_of_view_degrees = 30\n"
      "[[camera.key]]\ntime = 0.5\n[[camera.key]]\ntime = 2\nposition = [3, 1, 4]\nfield_of_view_degrees = 35\n",
      "path.toml");
  ASSERT_TRUE(load.scene) << (load.diagnostics.empty() ? "" : format(load.diagnostics[0]));
  const std::vector<CameraKey>& path = load.scene->cameras.at(0).path;
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path[0].time, 0.5);
  EXPECT_EQ(path[0].position, (Vec3{0, 1, 4})) << "the camera's own where the key says none";
  EXPECT_EQ(path[0].fieldOfViewDegrees, 30);
  EXPECT_EQ(path[1].position, (Vec3{3, 1, 4}));
  EXPECT_EQ(path[1].target, (Vec3{0, 1, 0}));
  EXPECT_EQ(path[1].fieldOfViewDegrees, 35);
}

}  // namespace
}  // namespace brickfall
