// Patterns of materials: in the body's space, the same every time, gone where they are too fine to be seen; and as images.
#include "appearance/surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "appearance/bake.h"
#include "appearance/noise.h"

namespace brickfall::appearance {
namespace {

const Vec3f kHalf{0.1075f, 0.0325f, 0.05125f};

Look brick(std::uint32_t number = 3) { return lookOf({"brick", BodyRole::brick, 0xB5543A, number}); }

// Mean and spread of the brightness over a face.
struct Spread {
  float mean = 0, deviation = 0;
};
Spread spreadOver(const Look& look, int axis, float footprint) {
  const BakeArea face = boxFace(kHalf, axis);
  double sum = 0, squares = 0;
  const int n = 60;
  for (int i = 0; i < n * n; i++) {
    SurfacePoint point{face.corner + face.u * ((float(i % n) + 0.5f) / n) + face.v * ((float(i / n) + 0.5f) / n),
                       face.normal, kHalf, footprint};
    const double light = brightness(paintAt(look, point).colour);
    sum += light;
    squares += light * light;
  }
  const double mean = sum / (n * n);
  return {float(mean), float(std::sqrt(std::max(0.0, squares / (n * n) - mean * mean)))};
}

TEST(Noise, IsSmoothBoundedAndOfItsSeed) {
  float low = 1, high = -1;
  for (int i = 0; i < 4000; i++) {
    const Vec3f p{float(i) * 0.037f - 60, float(i) * 0.011f, float(i) * -0.023f};
    const float v = valueNoise(p, 5);
    low = std::min(low, v);
    high = std::max(high, v);
    EXPECT_LT(std::fabs(valueNoise(p + Vec3f{1e-3f, 0, 0}, 5) - v), 0.01f);
    EXPECT_EQ(valueNoise(p, 5), v);
  }
  EXPECT_GE(low, -1);
  EXPECT_LE(high, 1);
  EXPECT_GT(high - low, 1.2f);
  EXPECT_NE(valueNoise({0.5f, 0.5f, 0.5f}, 5), valueNoise({0.5f, 0.5f, 0.5f}, 6));
}

TEST(Surface, StaysAMaterial) {
  for (const char* name : {"brick", "concrete", "stone", "wood", "steel", "rubber", "earth", "other"}) {
    const Look look = lookOf({name, BodyRole::body, 0x909090, 11});
    for (int i = 0; i < 500; i++) {
      SurfacePoint point;
      point.position = {0.2f * (chance(i, 1) - 0.5f), 0.2f * (chance(i, 2) - 0.5f), 0.2f * (chance(i, 3) - 0.5f)};
      point.normal = normalized(Vec3f{chance(i, 4) - 0.5f, chance(i, 5) - 0.5f, chance(i, 6) - 0.4f});
      point.footprint = i % 2 ? 0 : 0.002f;
      const Surface s = surfaceAt(look, point);
      for (int k = 0; k < 3; k++) {
        EXPECT_GE(s.colour[k], 0) << name;
        EXPECT_LE(s.colour[k], 1) << name;
      }
      EXPECT_NEAR(length(s.normal), 1, 1e-5f) << name;
      EXPECT_GT(dot(s.normal, point.normal), 0.2f) << name << ", never from behind";
      EXPECT_GE(s.roughness, 0);
      EXPECT_LE(s.roughness, 1);
      EXPECT_EQ(surfaceAt(look, point).colour, s.colour);
    }
  }
}

TEST(Surface, FacesOfABrickDiffer) {
  float ends = 0, sides = 0, beds = 0;
  for (std::uint32_t k = 0; k < 8; k++) {
    ends += spreadOver(brick(k), 0, 0).mean;
    beds += spreadOver(brick(k), 1, 0).mean;
    sides += spreadOver(brick(k), 2, 0).mean;
  }
  EXPECT_LT(ends, 0.95f * sides) << "burnt darker";
  EXPECT_GT(beds, 1.1f * sides) << "lime";
}

TEST(Surface, WhatIsTooFineFadesToItsMean) {
  const Spread close = spreadOver(brick(), 2, 0), far = spreadOver(brick(), 2, 0.01f),
               further = spreadOver(brick(), 2, 0.2f);
  EXPECT_GT(close.deviation, 0.1f * close.mean);
  EXPECT_LT(far.deviation, 0.8f * close.deviation);
  EXPECT_LT(further.deviation, 1e-4f);
  EXPECT_NEAR(further.mean / close.mean, 1, 0.2f);
  SurfacePoint point{{0.01f, 0.01f, kHalf.z}, {0, 0, 1}, kHalf, 0.02f};
  EXPECT_EQ(surfaceAt(brick(), point).normal, point.normal);
  point.footprint = 0;
  EXPECT_NE(surfaceAt(brick(), point).normal, point.normal);
}

TEST(Bake, ImagesAreTheSurface) {
  const Look look = brick();
  const BakeArea face = boxFace(kHalf, 2, true);
  const BakedImages images = bake(look, face, 64, 20);
  ASSERT_EQ(images.colour.size(), 4u * 64 * 20);
  ASSERT_EQ(images.normal.size(), images.colour.size());
  SurfacePoint point{face.corner + face.u * (10.5f / 64) + face.v * (4.5f / 20), face.normal, kHalf,
                     length(face.u) / 64};
  EXPECT_NEAR(point.position.z, -kHalf.z, 1e-6f);
  const Surface surface = surfaceAt(look, point);
  const std::size_t at = 4 * (4 * 64 + 10);
  EXPECT_NEAR(images.colour[at], toByte(srgbFromLinear(surface.colour.x)), 1);
  EXPECT_NEAR(images.colour[at + 3], toByte(surface.roughness), 1);
  EXPECT_GT(images.normal[at + 2], 200) << "outwards";
  // The same look gives the same images, a body of another number others.
  EXPECT_EQ(bake(look, face, 64, 20).colour, images.colour);
  EXPECT_NE(bake(brick(4), face, 64, 20).colour, images.colour);
}

TEST(Bake, FacesLieOnTheBoxAndFollowItsTextureCoordinates) {
  for (int axis = 0; axis < 3; axis++)
    for (bool negative : {false, true}) {
      const BakeArea face = boxFace(kHalf, axis, negative);
      EXPECT_NEAR(dot(face.corner, face.normal), kHalf[axis], 1e-6f);
      const Vec3f middle = face.corner + (face.u + face.v) * 0.5f;
      EXPECT_NEAR(length(middle - face.normal * kHalf[axis]), 0, 1e-6f);
      // Seen from outside u goes right and v down.
      EXPECT_NEAR(dot(cross(normalized(face.u), normalized(face.v)), face.normal), -1, 1e-5f);
    }
}

}  // namespace
}  // namespace brickfall::appearance
