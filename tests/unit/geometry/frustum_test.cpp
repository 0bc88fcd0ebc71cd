// Cylinders and cones against the definition: circles of many points, planes that part, directions by the thousand.
#include "geometry/frustum.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/queries.h"
#include "geometry/touch_axis.h"
#include "shape_samples.h"

namespace brickfall {
namespace {

constexpr ShapeType kTurned[] = {ShapeType::cylinder, ShapeType::cone};
constexpr ShapeType kOthers[] = {ShapeType::box,  ShapeType::sphere,   ShapeType::capsule,
                                 ShapeType::hull, ShapeType::cylinder, ShapeType::cone};

// Furthest the shape reaches along a direction of its frame.
double turnedReach(const Shape& shape, Vec3 direction) {
  if (!isFrustum(shape.type)) {
    test::Outline outline = test::outlineOf(shape);
    double furthest = -1e300;
    for (Vec3 c : outline.corners) furthest = std::max(furthest, dot(c, direction));
    return furthest + outline.radius;
  }
  double across = std::hypot(direction.x, direction.z),
         top = shape.type == ShapeType::cone ? shape.topRadius : shape.radius;
  return std::max(across * shape.radius - direction.y * shape.halfHeight,
                  across * top + direction.y * shape.halfHeight);
}

double gapAlong(const Shape& a, const Shape& b, const Transform& bInA, Vec3 n) {
  return dot(n, bInA.position) - turnedReach(b, rotate(conjugate(bInA.rotation), -n)) - turnedReach(a, n);
}

TEST(Frustum, BoundsAndRadiiAreTight) {
  test::ShapeSamples samples(1);
  for (int round = 0; round < 1000; round++) {
    Shape shape = samples.make(kTurned[round % 2]);
    Transform pose = test::randomPose(samples.random(), 5);
    Aabb box = bounds(shape, pose);
    for (int k = 0; k < 3; k++) {
      Vec3 axis;
      axis[k] = 1;
      Vec3 local = rotate(conjugate(pose.rotation), axis);
      EXPECT_NEAR(box.upper[k], turnedReach(shape, local) + pose.position[k], 1e-14);
      EXPECT_NEAR(box.lower[k], -turnedReach(shape, -local) + pose.position[k], 1e-14);
    }
    Vec3 middle{0, frustumOf(shape).centre(), 0}, far = test::randomVector(samples.random(), 1);
    double inner = innerRadius(shape), least = 1e300, furthest = 0, outer = outerRadius(shape, far);
    for (int k = 0; k < 500; k++) {
      Vec3 d = test::randomDirection(samples.random());
      least = std::min(least, turnedReach(shape, d) - dot(middle, d));
      furthest = std::max(furthest, length(frustumOf(shape).furthest(d) - far));
    }
    EXPECT_LE(inner, least + 1e-12);
    Vec3 out = footOn(frustumOf(shape), middle).normal;
    EXPECT_NEAR(inner, turnedReach(shape, out) - dot(middle, out), 1e-12);
    EXPECT_LE(furthest, outer + 1e-12);
  }
}

TEST(Frustum, ClosestPointMeetsTheConditionOfConvexity) {
  test::ShapeSamples samples(2);
  int inside = 0, outside = 0;
  for (int round = 0; round < 20000; round++) {
    Shape shape = samples.make(kTurned[round % 2]);
    Vec3 p = test::randomVector(samples.random(), round % 3 == 0 ? 0.5 : 2), c = closestPoint(shape, p);
    double distance = length(p - c);
    FrustumFoot foot = footOn(frustumOf(shape), p);
    EXPECT_NEAR(length(foot.normal), 1, 1e-12);
    if (distance > 0) {  // all of it is behind the plane through the foot
      outside++;
      EXPECT_LE(turnedReach(shape, foot.normal), dot(foot.point, foot.normal) + 1e-9);
      EXPECT_NEAR(foot.distance, distance, 1e-14);
    } else {  // the ball of that radius around it just fits
      inside++;
      EXPECT_NEAR(turnedReach(shape, foot.normal) - dot(p, foot.normal), -foot.distance, 1e-12);
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 10000);
}

// As far as GJK says that two are apart, a plane across shows it.
TEST(Frustum, DistanceShowsAPlaneBetween) {
  test::ShapeSamples samples(3);
  int apart = 0;
  for (int round = 0; round < 12000; round++) {
    Shape a = samples.make(kOthers[round % 6]), b = samples.make(kTurned[round / 6 % 2]);
    Transform pose = test::randomPose(samples.random(), round % 7 == 0 ? 50 : 2.5);
    if (round % 11 == 0) pose.rotation = {};
    DistanceResult found = shapeDistance(a, b, pose);
    if (!(found.distance > 1e-3)) continue;
    apart++;
    SCOPED_TRACE("round " + std::to_string(round));
    Vec3 n = (found.onB - found.onA) * (1 / found.distance);
    EXPECT_NEAR(gapAlong(a, b, pose, n), found.distance, 1e-7);
    EXPECT_LE(length(closestPoint(a, found.onA) - found.onA), 1e-9);
    Vec3 local = transformPoint(inverse(pose), found.onB);
    EXPECT_LE(length(closestPoint(b, local) - local), 1e-9);
    EXPECT_NEAR(shapeDistance(b, a, inverse(pose)).distance, found.distance, 1e-7);
  }
  EXPECT_GT(apart, 4000);
}

// Brought together along the closest points until a known overlap is left: the axis says no more than that, and exactly what
// reaches over along it.
TEST(Frustum, TouchAxisOfALittleOverlap) {
  test::ShapeSamples samples(4);
  int checked = 0;
  for (int round = 0; round < 3000; round++) {
    Shape a = samples.make(kOthers[round % 6]), b = samples.make(kTurned[round / 6 % 2]);
    Transform pose = test::randomPose(samples.random(), 3);
    DistanceResult apart = shapeDistance(a, b, pose);
    if (apart.distance < 0.1) continue;
    Vec3 n = (apart.onB - apart.onA) * (1 / apart.distance);
    for (double overlap : {1e-9, 1e-6, 1e-4}) {
      checked++;
      Transform near{pose.position - n * (apart.distance + overlap), pose.rotation};
      std::optional<TouchAxis> axis = findTouchAxis(a, b, near, 0.01);
      SCOPED_TRACE("round " + std::to_string(round) + " overlap " + std::to_string(overlap * 1e9) + "e-9");
      ASSERT_TRUE(axis);
      EXPECT_GE(axis->separation, -overlap - 2e-6);
      EXPECT_NEAR(gapAlong(a, b, near, axis->normal), axis->separation, 1e-9);
      EXPECT_LE(length(closestPoint(a, axis->onA) - axis->onA), 1e-5);
      Vec3 local = transformPoint(inverse(near), axis->onB);
      EXPECT_LE(length(closestPoint(b, local) - local), 1e-5);
    }
  }
  EXPECT_GT(checked, 4000);
}

// No direction of thousands shows less overlap, but for a few deep ones: the search climbs from the best start, not from all.
TEST(Frustum, PenetrationIsTheLeastOverlap) {
  test::ShapeSamples samples(5);
  int deep = 0, missed = 0;
  for (int round = 0; round < 600; round++) {
    Shape a = samples.make(kOthers[round % 6]), b = samples.make(kTurned[round / 6 % 2]);
    Transform pose = test::randomPose(samples.random(), 1);
    double depth = penetrationDepth(a, b, pose), least = 1e300;
    if (!(depth > 0)) continue;
    deep++;
    for (int k = 0; k < 2000; k++)
      least = std::min(least, -gapAlong(a, b, pose, test::randomDirection(samples.random())));
    missed += depth > least + 1e-6;
  }
  EXPECT_GT(deep, 200);
  EXPECT_LE(missed, deep / 30);
}

TEST(Frustum, TextbookMass) {
  Shape cylinder, cone;
  cylinder.type = ShapeType::cylinder, cylinder.radius = 0.3, cylinder.halfHeight = 0.15;
  cone.type = ShapeType::cone, cone.radius = 0.3, cone.halfHeight = 0.2;
  const double pi = 3.14159265358979323846, drum = pi * 0.09 * 0.3, point = pi * 0.09 * 0.4 / 3;
  EXPECT_EQ(closestPoint(cone, {0, 0.25, 0}), (Vec3{0, 0.2, 0}));
  EXPECT_NEAR(frustumOf(cone).centre(), -0.1, 1e-15);  // a quarter of the height above the base
  EXPECT_NEAR(innerRadius(cylinder), 0.15, 1e-15);
  EXPECT_NEAR(outerRadius(cylinder, {}), std::sqrt(0.09 + 0.0225), 1e-15);
  EXPECT_NEAR(bounds(cone, {}).upper.x, 0.3, 1e-15);
  EXPECT_GT(drum, point);
}

}  // namespace
}  // namespace brickfall
