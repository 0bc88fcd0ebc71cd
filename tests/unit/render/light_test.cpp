// What a picture is made of before anything is traced: numbers, sky, tones, rays of the camera.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "render/camera_rays.h"
#include "render/sampler.h"
#include "render/sky.h"
#include "render/tone_map.h"

namespace brickfall::render {
namespace {

// Sixteen samples of a pixel: one in each sixteenth of the square, whichever way it is cut (a net in base 2).
TEST(Sampler, NumbersOfAPixelAreSpreadEvenly) {
  for (int pixel = 0; pixel < 20; pixel++)
    for (int purpose = 0; purpose < 6; purpose++) {
      const Sampler numbers(pixel * 7, pixel * 3, 2, 16);
      for (int bits : {1, 2, 3, 4})  // also its first 2, 4, 8
        for (int cut = 0; cut <= bits; cut++) {
          std::set<int> cells;
          for (int k = 0; k < 1 << bits; k++) {
            const Pair pair = numbers.pair(k, purpose);
            ASSERT_TRUE(pair.x >= 0 && pair.x < 1 && pair.y >= 0 && pair.y < 1);
            cells.insert(int(pair.x * float(1 << cut)) * 100 + int(pair.y * float(1 << (bits - cut))));
          }
          EXPECT_EQ(cells.size(), 1u << bits) << pixel << " " << purpose << " " << cut;
        }
    }
}

// So are those that every pixel takes of a square of pixels together: 4 of 4, 2 of 8. Purposes do not follow each other.
TEST(Sampler, NeighboursShareTheWorkAndPurposesDiffer) {
  double product = 0;
  for (int all : {4, 2})
    for (int purpose = 0; purpose < 6; purpose++) {
      std::set<int> cells;
      for (int k = 0; k < 16; k++) {
        const int pixel = k / all;
        const Sampler numbers(12 + pixel % 2 + pixel / 4 * 2, 20 + pixel / 2 % 2, all, 4 * all);
        const Pair pair = numbers.pair(k % all, purpose);
        cells.insert(int(pair.x * 4) * 4 + int(pair.y * 4));
      }
      EXPECT_EQ(cells.size(), 16u) << all << " " << purpose;
    }
  // What more they take is not the same in each.
  std::set<float> further;
  for (int x = 0; x < 4; x++) further.insert(Sampler(x, 0, 2, 16).pair(9, 1).x);
  EXPECT_EQ(further.size(), 4u);
  const int many = 4096;
  const Sampler numbers(3, 5, many / 2, many);
  for (int k = 0; k < many; k++) product += (numbers.pair(k, 0).x - 0.5) * (numbers.pair(k, 1).x - 0.5) / many;
  EXPECT_NEAR(product, 0, 0.004) << "variance of each is 1/12";
}

TEST(Sky, IsBrightAtTheHorizonAndAroundTheSun) {
  Sky sky;
  sky.sun = appearance::sunDirection(30, 45);
  EXPECT_NEAR(length(sky.sun), 1, 1e-6f);
  EXPECT_NEAR(sky.sun.y, std::sqrt(0.5f), 1e-6f);
  EXPECT_GT(sky.sun.x, 0);
  const Vec3f away = appearance::sunDirection(210, 45), level = appearance::sunDirection(210, 0.1);
  EXPECT_GT(appearance::brightness(sky.radiance(sky.sun)), 1.5f * appearance::brightness(sky.radiance(away)));
  EXPECT_GT(appearance::brightness(sky.radiance(level)), appearance::brightness(sky.radiance({0, 1, 0})));
  EXPECT_GT(sky.radiance({0, 1, 0}).z, sky.radiance({0, 1, 0}).x) << "blue above";
  const float mean = appearance::brightness(sky.mean());
  EXPECT_GT(mean, appearance::brightness(sky.radiance({0, 1, 0})) * 0.9f);
  EXPECT_LT(mean, appearance::brightness(sky.radiance(sky.sun)));
  for (int k = 0; k < 200; k++) {
    const Vec3f d = appearance::sunDirection(k * 37.0, k * 0.9 - 90);
    const Rgb light = sky.radiance(d), beside = sky.radiance(normalized(d + Vec3f{1e-3f, 1e-3f, 0}));
    EXPECT_TRUE(light.x > 0 && light.x < 10);
    EXPECT_LT(length(beside - light), 0.1f) << "no edge anywhere";
  }
}

TEST(ToneMap, RisesStaysBelowOneAndKeepsBlack) {
  EXPECT_EQ(appearance::toneMapped({0, 0, 0}, 1), (Rgb{0, 0, 0}));
  float before = -1;
  for (float light = 0; light < 50; light += 0.01f) {
    const float shown = appearance::toneMapped({light, light, light}, 0.9f).x;
    EXPECT_GT(shown, before);
    EXPECT_LT(shown, 1);
    before = shown;
  }
  EXPECT_EQ(appearance::toneMapped({0.2f, 0.1f, 0.05f}, 2).y, 0.2f) << "below the shoulder nothing is changed";
  const Rgb red = appearance::toneMapped({8, 0.5f, 0.2f}, 1);
  EXPECT_GT(red.x, red.y);
  EXPECT_EQ(pixelOf({0, 0, 0}, 1, 0.99f), (std::array<std::uint8_t, 3>{0, 0, 0}));
  EXPECT_GE(pixelOf({90, 90, 90}, 1, 0)[0], 252);
  for (int v = 1; v < 158; v++) {  // sRGB of what lies below the shoulder, to half a step
    const float light = appearance::linearFromSrgb(float(v) / 255);
    if (light >= 0.6f) break;
    EXPECT_EQ(pixelOf({light, light, light}, 1, 0.5f)[1], v);
  }
}

TEST(CameraRays, GoThroughThePicture) {
  Camera camera;
  camera.position = {0, 1, 5};
  camera.target = {0, 1, 0};
  camera.fieldOfViewDegrees = 90;
  const CameraRays rays(camera, camera, 200, 100);
  EXPECT_FALSE(rays.moves());
  const Ray middle = rays.through(100, 50, 0), top = rays.through(100, 0, 0), right = rays.through(200, 50, 0);
  EXPECT_NEAR(length(middle.direction - Vec3f{0, 0, -1}), 0, 1e-6f);
  EXPECT_NEAR(top.direction.y, std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(right.direction.x / -right.direction.z, 2, 1e-5f) << "twice as wide as high";
  EXPECT_NEAR(rays.pixelAngle(), 2.0 / 100, 1e-6);
  Camera later = camera;
  later.position.x = 2;
  const CameraRays moving(camera, later, 200, 100);
  EXPECT_TRUE(moving.moves());
  EXPECT_NEAR(moving.through(100, 50, 0.5f).origin.x, 1, 1e-6f);
  camera.target = {0, 9, 5};  // straight up
  EXPECT_NEAR(CameraRays(camera, camera, 64, 64).through(32, 32, 0).direction.y, 1, 1e-6f);
}

}  // namespace
}  // namespace brickfall::render
