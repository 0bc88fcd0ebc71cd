// Two boxes against answers found independently (tests/support/obb_vectors.json), as boxes and as hulls.
#include "support/obb_vectors.h"

#include <gtest/gtest.h>

#include "geometry/hull.h"
#include "geometry/queries.h"

namespace brickfall {
namespace {

struct Pair {
  Hull hullA, hullB;
  Shape a, b;
  Transform bInA;
};

Hull boxHull(Vec3 h) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; k++) corners.push_back({k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
  Result<Hull> hull = buildHull(corners);
  EXPECT_TRUE(hull) << hull.error().message;
  return hull ? *hull : Hull{};
}

// Bits 0 and 1 of `asHulls`: a, b as hulls.
void makePair(const test::ObbVector& v, int asHulls, Pair& pair) {
  pair.a.halfExtents = v.halfA, pair.b.halfExtents = v.halfB;
  if (asHulls & 1) pair.hullA = boxHull(v.halfA), pair.a.hull = &pair.hullA, pair.a.type = ShapeType::hull;
  if (asHulls & 2) pair.hullB = boxHull(v.halfB), pair.b.hull = &pair.hullB, pair.b.type = ShapeType::hull;
  pair.bInA = inverse(v.poseA) * v.poseB;
}

class ObbVectors : public testing::TestWithParam<int> {};

TEST_P(ObbVectors, OverlapDistanceAndDepth) {
  int overlapping = 0, apart = 0;
  for (const test::ObbVector& v : test::obbVectors()) {
    Pair pair;
    makePair(v, GetParam(), pair);
    SCOPED_TRACE("vector " + std::to_string(v.id) + " " + v.category);
    double distance = shapeDistance(pair.a, pair.b, pair.bInA).distance;
    double depth = penetrationDepth(pair.a, pair.b, pair.bInA);
    ASSERT_TRUE(v.distance);
    EXPECT_NEAR(distance, *v.distance, v.tolerance);
    EXPECT_NEAR(depth, v.penetration.value_or(0), v.tolerance);
    EXPECT_FALSE(distance > v.tolerance && depth > v.tolerance);
    EXPECT_TRUE(v.borderline || (depth > 0) == v.overlap);
    (v.overlap ? overlapping : apart)++;
  }
  EXPECT_GE(overlapping, 50);
  EXPECT_GE(apart, 50);
}

TEST_P(ObbVectors, TimeOfImpact) {
  int hits = 0;
  for (const test::ObbVector& v : test::obbVectors()) {
    double speed = length(v.relativeVelocity);
    if (v.size < 1e-3 || v.size > 1e4) continue;  // the tolerance of the query is a length, 1e-6 m
    Pair pair;
    makePair(v, GetParam(), pair);
    SCOPED_TRACE("vector " + std::to_string(v.id) + " " + v.category);
    Vec3 motion = rotate(conjugate(v.poseA.rotation), v.relativeVelocity * v.maxTime);
    std::optional<double> time = timeOfImpact(pair.a, pair.b, pair.bInA, motion, 0);
    EXPECT_TRUE(v.borderline || time.has_value() == v.timeOfImpact.has_value());
    if (!time || !v.timeOfImpact) continue;
    hits++;
    // Early by at most the tolerance over the approach speed along the normal: compare by what is left to travel.
    Vec3 left = motion * (*v.timeOfImpact / (v.maxTime > 0 ? v.maxTime : 1) - *time);
    EXPECT_GE(*v.timeOfImpact - *time * v.maxTime, -(1e-9 * v.size + v.tolerance) / (speed > 0 ? speed : 1));
    Transform late{pair.bInA.position + motion * *time, pair.bInA.rotation};
    EXPECT_LE(shapeDistance(pair.a, pair.b, late).distance, 1.01e-6);
    EXPECT_LE(length(left), 1e-3 * v.size);
  }
  EXPECT_GE(hits, 80);
}

INSTANTIATE_TEST_SUITE_P(AsBoxAndHull, ObbVectors, testing::Values(0, 1, 2, 3));

}  // namespace
}  // namespace brickfall
