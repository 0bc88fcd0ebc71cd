// The joints of a floor broke into dots far off: a pixel that is seen flat was taken for as long as wide.
#include "render/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace brickfall::render {
namespace {

TEST(CameraRays, APixelOnTheFloorIsAsLongAsTheWayToTheNext) {
  Camera camera;
  camera.position = {0.5, 1.2, 4};
  camera.target = {0, 0.9, 0};
  const CameraRays rays(camera, camera, 640, 360);
  const Vec3f up{0, 1, 0};
  const auto met = [&](float x, float y) {
    const Ray ray = rays.through(x, y, 0);
    return ray.origin + ray.direction * (-ray.origin.y / ray.direction.y);
  };
  for (const auto& [x, y] : {std::pair{320.5f, 350.5f}, std::pair{40.5f, 260.5f}, std::pair{600.5f, 200.5f}}) {
    const Ray ray = rays.through(x, y, 0);
    const Vec3f found = rays.footprint(ray, -ray.origin.y / ray.direction.y, up, Mat3f{});
    Vec3f wanted;
    for (const Vec3f next : {met(x + 0.5f, y) - met(x - 0.5f, y), met(x, y + 0.5f) - met(x, y - 0.5f)})
      for (int k = 0; k < 3; k++) wanted[k] += std::fabs(next[k]);
    EXPECT_NEAR(found.x, wanted.x, 0.05f * wanted.x) << x << ' ' << y;
    EXPECT_NEAR(found.z, wanted.z, 0.05f * wanted.z) << x << ' ' << y;
    EXPECT_NEAR(found.y, 0, 1e-5f);
  }
}

}  // namespace
}  // namespace brickfall::render
