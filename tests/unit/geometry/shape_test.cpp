// Bounds and radii: they hold every point, and no smaller ones do.
#include "geometry/shape.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/queries.h"
#include "shape_samples.h"

namespace brickfall {
namespace {

constexpr ShapeType kSolids[] = {ShapeType::box, ShapeType::sphere, ShapeType::capsule, ShapeType::hull};

// Furthest the shape reaches along a direction, from its outline.
double reach(const Shape& shape, Vec3 direction) {
  test::Outline outline = test::outlineOf(shape);
  double furthest = -1e300;
  for (Vec3 c : outline.corners) furthest = std::max(furthest, dot(c, direction));
  return furthest + outline.radius;
}

TEST(Shape, BoundsAreTight) {
  test::ShapeSamples samples(1);
  for (int round = 0; round < 2000; round++) {
    Shape shape = samples.make(kSolids[round % 4]);
    Transform pose = test::randomPose(samples.random(), 5);
    Aabb box = bounds(shape, pose);
    for (int k = 0; k < 3; k++) {
      Vec3 axis;
      axis[k] = 1;
      Vec3 local = rotate(conjugate(pose.rotation), axis);
      EXPECT_NEAR(box.upper[k], reach(shape, local) + pose.position[k], 1e-14);
      EXPECT_NEAR(box.lower[k], -reach(shape, -local) + pose.position[k], 1e-14);
    }
  }
}

TEST(Shape, PlaneIsBoundedOnlyAboveAlongAWorldAxis) {
  Shape plane;
  plane.type = ShapeType::plane;
  Aabb level = bounds(plane, {{1, 2, 3}, {}});
  EXPECT_EQ(level.upper.y, 2);
  EXPECT_EQ(level.lower.y, -1e30);
  EXPECT_EQ(level.upper.x, 1e30);
  Aabb wall = bounds(plane, {{1, 2, 3}, quatFromAxisAngle({0, 0, 1}, 1.57079632679489661923)});  // +y turns to -x
  EXPECT_EQ(wall.lower.x, 1);
  EXPECT_EQ(wall.upper.x, 1e30);
  EXPECT_EQ(wall.upper.y, 1e30);
  Aabb sloping = bounds(plane, {{1, 2, 3}, quatFromAxisAngle({0, 0, 1}, 1e-3)});
  EXPECT_EQ(sloping.upper.y, 1e30);
}

TEST(Shape, InnerAndOuterRadius) {
  test::ShapeSamples samples(2);
  for (int round = 0; round < 800; round++) {
    Shape shape = samples.make(kSolids[round % 4]);
    Vec3 centre = shape.type == ShapeType::hull ? shape.hull->centroid : Vec3{};
    double inner = innerRadius(shape), nearest = 1e300;
    for (int k = 0; k < 200; k++) {
      Vec3 d = test::randomDirection(samples.random());
      EXPECT_EQ(closestPoint(shape, centre + d * (inner * 0.999999)), centre + d * (inner * 0.999999));
      nearest = std::min(nearest, reach(shape, d) - dot(centre, d));
    }
    EXPECT_LE(inner, nearest + 1e-12);
    Vec3 point = test::randomVector(samples.random(), 1);
    test::Outline outline = test::outlineOf(shape);
    double furthest = 0;
    for (Vec3 c : outline.corners) furthest = std::max(furthest, length(c - point) + outline.radius);
    EXPECT_NEAR(outerRadius(shape, point), furthest, 1e-14);
  }
  Shape plane;
  plane.type = ShapeType::plane;
  EXPECT_EQ(innerRadius(plane), 1e30);
  EXPECT_EQ(outerRadius(plane, {}), 1e30);
}

}  // namespace
}  // namespace brickfall
