// Rays against marching by the distance to the closest point, a method that shares nothing with the clipping; closest
// points against the condition that defines them.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <span>

#include "geometry/queries.h"
#include "shape_samples.h"

namespace brickfall {
namespace {

constexpr ShapeType kTypes[] = {ShapeType::box, ShapeType::sphere, ShapeType::capsule, ShapeType::hull,
                                ShapeType::plane};

constexpr ShapeType kCircular[] = {ShapeType::cylinder, ShapeType::cone};

// Steps along the ray by the distance that is certainly free. Slow near grazing; < 0: nothing met.
double march(const Shape& shape, Vec3 origin, Vec3 direction, double maxDistance) {
  double t = 0;
  for (int step = 0; step < 20000 && t <= maxDistance; step++) {
    Vec3 p = origin + direction * t;
    double free = length(p - closestPoint(shape, p));
    if (free < 1e-9) return t;
    t += free;
  }
  return -1;
}

// c is the closest point of a convex shape to p exactly if it is in the shape and no point of the shape lies beyond the
// plane through c across p - c.
TEST(ClosestPoint, MeetsTheConditionOfConvexity) {
  test::ShapeSamples samples(1);
  int inside = 0, outside = 0;
  for (int round = 0; round < 20000; round++) {
    Shape shape = samples.make(kTypes[round % 4]);
    Vec3 p = test::randomVector(samples.random(), round % 3 == 0 ? 0.5 : 2), c = closestPoint(shape, p);
    test::Outline outline = test::outlineOf(shape);
    double distance = length(p - c);
    distance > 0 ? outside++ : inside++;
    for (Vec3 corner : outline.corners) {
      EXPECT_LE(dot(p - c, corner - c) + outline.radius * distance, 1e-6 * distance + 1e-14) << "type " << round % 4;
    }
    EXPECT_LE(length(closestPoint(shape, c) - c), 1e-14);
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 10000);
}

TEST(ClosestPoint, OfThePlane) {
  Shape plane;
  plane.type = ShapeType::plane;
  EXPECT_EQ(closestPoint(plane, {1, 2, 3}), (Vec3{1, 0, 3}));
  EXPECT_EQ(closestPoint(plane, {1, -2, 3}), (Vec3{1, -2, 3}));
}

struct Outcomes {
  int hits = 0, misses = 0, starts = 0;  // rays that begin within the shape
};
Outcomes compareWithMarching(std::span<const ShapeType> types, std::uint64_t seed, int rounds) {
  test::ShapeSamples samples(seed);
  int hits = 0, misses = 0, starts = 0;
  for (int round = 0; round < rounds; round++) {
    Shape shape = samples.make(types[std::size_t(round) % types.size()]);
    Vec3 origin = test::randomVector(samples.random(), 2), aim = test::randomVector(samples.random(), 0.8);
    Vec3 direction = normalized(aim - origin);
    SCOPED_TRACE("round " + std::to_string(round));
    auto hit = castRay(shape, origin, direction, 10);
    double expected = march(shape, origin, direction, 10);
    if (hit && hit->distance == 0) {
      starts++;
      EXPECT_EQ(closestPoint(shape, origin), origin);
      EXPECT_EQ(hit->normal, -direction);
      continue;
    }
    if (!hit) {
      misses++;
      EXPECT_LT(expected, 0);
      continue;
    }
    hits++;
    double slope = -dot(hit->normal, direction);
    EXPECT_GE(slope, 0);
    EXPECT_NEAR(hit->distance, expected, 1e-8 / std::max(slope, 1e-3));
    EXPECT_NEAR(length(hit->normal), 1, 1e-14);
    EXPECT_LE(length(hit->point - (origin + direction * hit->distance)), 1e-12);
    Vec3 above = hit->point + hit->normal * 1e-3;
    EXPECT_NEAR(length(above - closestPoint(shape, above)), 1e-3, 1e-8);
    EXPECT_FALSE(castRay(shape, origin, direction, hit->distance * (1 - 1e-9)));
    EXPECT_TRUE(castRay(shape, origin, direction, hit->distance * (1 + 1e-9)));
  }
  return {hits, misses, starts};
}

TEST(RayCast, AgreesWithMarching) {
  const Outcomes of = compareWithMarching(kTypes, 2, 20000);
  EXPECT_GT(of.hits, 5000);
  EXPECT_GT(of.misses, 2000);
  EXPECT_GT(of.starts, 2000);
  const Outcomes circular = compareWithMarching(kCircular, 6, 6000);
  EXPECT_GT(circular.hits, 1500);
  EXPECT_GT(circular.misses, 300);
  EXPECT_GT(circular.starts, 60);
}

TEST(RayCast, AlongAxesAndFaces) {
  Shape box;
  box.halfExtents = {1, 2, 3};
  for (int k = 0; k < 3; k++) {
    for (double sign : {-1.0, 1.0}) {
      Vec3 origin, direction;
      origin[k] = -10 * sign, direction[k] = sign;
      auto hit = castRay(box, origin, direction, 100);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->distance, 10 - box.halfExtents[k]);
      EXPECT_EQ(hit->normal, -direction);
      origin[(k + 1) % 3] = box.halfExtents[(k + 1) % 3];  // along a face: closed, so it hits
      EXPECT_TRUE(castRay(box, origin, direction, 100));
      origin[(k + 1) % 3] *= 1 + 1e-12;
      EXPECT_FALSE(castRay(box, origin, direction, 100));
    }
  }
}

// A ray from a kilometre away meets a ball of a centimetre as exactly as doubles allow.
TEST(RayCast, FarOriginsStayExact) {
  test::ShapeSamples samples(3);
  Shape sphere;
  sphere.type = ShapeType::sphere;
  sphere.radius = 0.01;
  for (int round = 0; round < 1000; round++) {
    Vec3 direction = test::randomDirection(samples.random());
    Vec3 side = normalized(cross(direction, test::randomDirection(samples.random()))) * 0.005;
    auto hit = castRay(sphere, direction * -1000.0 + side, direction, 2000);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 1000 - std::sqrt(0.01 * 0.01 - 0.005 * 0.005), 1e-12);
    EXPECT_NEAR(length(hit->point), 0.01, 1e-15);
  }
}

TEST(RayCast, SenselessRaysMeetNothing) {
  double nan = std::numeric_limits<double>::quiet_NaN();
  test::ShapeSamples samples(4);
  for (ShapeType type : kTypes) {
    Shape shape = samples.make(type);
    EXPECT_FALSE(castRay(shape, {0, 5, 0}, {0, -1, 0}, -1));
    EXPECT_FALSE(castRay(shape, {0, 5, 0}, {0, -1, 0}, nan));
    EXPECT_FALSE(castRay(shape, {0, 5, 0}, {0, 1, 0}, 100));
  }
}

}  // namespace
}  // namespace brickfall
