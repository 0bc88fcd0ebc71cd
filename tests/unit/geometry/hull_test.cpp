// Hull building: known solids, random sets against Qhull, sets that break hull builders, bad input.
#include "geometry/hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "qhull_oracle.h"
#include "support/random_geometry.h"

namespace brickfall {
namespace {

using test::randomPoints;

std::vector<Vec3> boxCorners(Vec3 h) {
  std::vector<Vec3> out;
  for (int k = 0; k < 8; k++) out.push_back({k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
  return out;
}

std::vector<Vec3> prism(int sides, double radius, double halfHeight) {
  std::vector<Vec3> out;
  for (int k = 0; k < sides; k++) {
    double s, c;
    sinCos(2 * 3.14159265358979323846 * k / sides, s, c);
    out.push_back({radius * c, halfHeight, radius * s});
    out.push_back({radius * c, -halfHeight, radius * s});
  }
  return out;
}

double sizeOf(const std::vector<Vec3>& points) {
  Vec3 lower = points[0], upper = lower;
  for (Vec3 p : points) lower = min(lower, p), upper = max(upper, p);
  return length(upper - lower);
}

double furthestOutside(const Hull& hull, const std::vector<Vec3>& points) {
  double furthest = 0;
  for (Vec3 p : points) {
    for (const HullPlane& plane : hull.planes) furthest = std::max(furthest, dot(plane.normal, p) - plane.offset);
  }
  return furthest;
}

void expectHull(const std::vector<Vec3>& points, std::size_t vertices, std::size_t faces, double volume) {
  Result<Hull> hull = buildHull(points);
  ASSERT_TRUE(hull) << hull.error().message;
  EXPECT_EQ(hull->vertices.size(), vertices);
  EXPECT_EQ(hull->planes.size(), faces);
  EXPECT_NEAR(hull->volume, volume, 1e-9 * volume);
  EXPECT_EQ(validate(*hull), "");
}

void expectError(const std::vector<Vec3>& points, ErrorCode code, const std::string& part) {
  Result<Hull> hull = buildHull(points);
  ASSERT_FALSE(hull);
  EXPECT_EQ(hull.error().code, code);
  EXPECT_NE(hull.error().message.find("vertices"), std::string::npos) << hull.error().message;
  EXPECT_NE(hull.error().message.find("expected"), std::string::npos) << hull.error().message;
  EXPECT_NE(hull.error().message.find(part), std::string::npos) << hull.error().message;
}

TEST(Hull, KnownSolids) {
  expectHull(boxCorners({0.12, 0.03, 0.05}), 8, 6, 8 * 0.12 * 0.03 * 0.05);
  expectHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 4, 4, 1.0 / 6);
  expectHull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, 6, 8, 4.0 / 3);
  double s, c;
  sinCos(2 * 3.14159265358979323846 / 32, s, c);
  expectHull(prism(32, 0.5, 1), 64, 34, 32 * 0.5 * 0.25 * s * 2);
}

TEST(Hull, CornersStayAsGiven) {
  std::vector<Vec3> corners = boxCorners({0.1075, 0.0325, 0.05125});
  Result<Hull> hull = buildHull(corners);
  ASSERT_TRUE(hull);
  for (Vec3 v : hull->vertices) EXPECT_NE(std::find(corners.begin(), corners.end(), v), corners.end());
  EXPECT_NEAR(length(hull->centroid), 0, 1e-15);
}

TEST(Hull, RotatedBoxesInFloatKeepSixFaces) {
  Random random(1);
  for (int round = 0; round < 500; round++) {
    Vec3 half{random.between(0.02, 1), random.between(0.02, 1), random.between(0.02, 1)};
    Transform pose = test::randomPose(random, 1);
    std::vector<Vec3> points = boxCorners(half);
    for (Vec3& p : points) {
      p = transformPoint(pose, p);
      p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
    }
    Result<Hull> hull = buildHull(points);
    ASSERT_TRUE(hull) << hull.error().message;
    EXPECT_EQ(hull->vertices.size(), 8u);
    EXPECT_EQ(hull->planes.size(), 6u);
    EXPECT_NEAR(hull->volume, 8 * half.x * half.y * half.z, 1e-5 * hull->volume);
  }
}

// A box with points all over its faces, edges and inside is a box, in whatever order they come.
TEST(Hull, GridOfPointsIsABox) {
  std::vector<Vec3> points;
  for (int x = 0; x <= 8; x++) {
    for (int y = 0; y <= 8; y++) {
      for (int z = 0; z <= 8; z++) points.push_back({x * 0.1, y * 0.037, z * 0.0411});
    }
  }
  Random random(2);
  for (int round = 0; round < 20; round++) {
    for (std::size_t k = points.size(); k > 1; k--) std::swap(points[k - 1], points[random.below(std::uint32_t(k))]);
    expectHull(points, 8, 6, 0.8 * 8 * 0.037 * 8 * 0.0411);
  }
}

TEST(Hull, DoesNotDependOnTheOrderOfPoints) {
  Random random(3);
  std::vector<Vec3> points = randomPoints(random, 40, {1, 0.5, 0.2});
  Result<Hull> first = buildHull(points);
  ASSERT_TRUE(first);
  for (int round = 0; round < 20; round++) {
    for (std::size_t k = points.size(); k > 1; k--) std::swap(points[k - 1], points[random.below(std::uint32_t(k))]);
    Result<Hull> again = buildHull(points);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->vertices, first->vertices);
    EXPECT_EQ(again->firstEdge, first->firstEdge);
    EXPECT_EQ(again->volume, first->volume);
  }
}

TEST(Hull, RandomSetsAgreeWithQhull) {
  Random random(4);
  for (int round = 0; round < 3000; round++) {
    Vec3 axes{random.between(0.01, 1), random.between(0.01, 1), random.between(0.01, 1)};
    int count = 4 + int(random.below(61));
    std::vector<Vec3> points = randomPoints(random, count, axes, round % 2 == 0);
    Transform pose = test::randomPose(random, round % 5 == 0 ? 1000 : 1);
    for (Vec3& p : points) p = transformPoint(pose, p);
    Result<Hull> hull = buildHull(points);
    ASSERT_TRUE(hull) << "round " << round << ": " << hull.error().message;
    ASSERT_EQ(validate(*hull), "") << "round " << round;
    double size = sizeOf(points);
    EXPECT_LE(furthestOutside(*hull, points), 1e-6 * size) << "round " << round;
    test::QhullAnswer oracle = test::qhull(points);
    EXPECT_NEAR(hull->volume, oracle.volume, 1e-6 * size * size * size) << "round " << round;
    EXPECT_LE(hull->vertices.size(), oracle.vertices) << "round " << round;
    EXPECT_GE(hull->vertices.size() + 1, oracle.vertices) << "round " << round;
  }
}

// Small integer coordinates: many points on common planes and lines, often doubled.
TEST(Hull, LatticePointsAgreeWithQhullAndAreExact) {
  Random random(5);
  int built = 0;
  for (int round = 0; round < 5000; round++) {
    int side = 2 + int(random.below(4)), count = 4 + int(random.below(40));
    std::vector<Vec3> points;
    for (int k = 0; k < count; k++) {
      auto coordinate = [&] { return double(random.below(std::uint32_t(side))); };
      double x = coordinate(), y = coordinate();
      points.push_back({x, y, coordinate()});
    }
    Result<Hull> hull = buildHull(points);
    if (!hull) {  // only flat sets may fail
      EXPECT_EQ(hull.error().code, ErrorCode::badGeometry);
      EXPECT_EQ(test::qhull(points).volume, 0) << hull.error().message;
      continue;
    }
    built++;
    test::QhullAnswer oracle = test::qhull(points);
    EXPECT_NEAR(hull->volume, oracle.volume, 1e-12 * oracle.volume);
    EXPECT_EQ(hull->vertices.size(), oracle.vertices) << "round " << round;
    EXPECT_EQ(hull->planes.size(), oracle.facets) << "round " << round;
    EXPECT_LE(furthestOutside(*hull, points), 1e-12);
  }
  EXPECT_GT(built, 4000);
}

// Noise of every magnitude on flat faces: around the merging tolerance faces are neither flat nor not.
TEST(Hull, NoisyFacesAlwaysGiveASolid) {
  Random random(6);
  for (int round = 0; round < 4000; round++) {
    double noise = 1;
    for (int k = int(random.below(14)); k >= 0; k--) noise *= 0.1;
    std::vector<Vec3> points = round % 2 ? boxCorners({0.5, 0.5, 0.5}) : prism(8, 0.5, 0.2);
    std::size_t corners = points.size();
    for (std::size_t k = 0; k < corners; k++) {
      points.push_back((points[k] + points[random.below(std::uint32_t(corners))]) * 0.5);
      points.push_back(points[k]);
    }
    for (Vec3& p : points) p += test::randomVector(random, noise);
    Result<Hull> hull = buildHull(points);
    ASSERT_TRUE(hull) << "round " << round << " noise " << noise << ": " << hull.error().message;
    ASSERT_EQ(validate(*hull), "");
    EXPECT_LE(furthestOutside(*hull, points), 3e-6) << "noise " << noise;
    // Below 1e-12 Qhull itself loses faces now and then, but there the volume is known.
    double known = round % 2 ? 1 : 8 * 0.5 * 0.25 * std::sqrt(0.5) * 0.4;
    EXPECT_NEAR(hull->volume, noise < 1e-12 ? known : test::qhull(points).volume, 5e-6) << "noise " << noise;
  }
}

TEST(Hull, ThinAndLongSolids) {
  for (double thin : {1e-2, 1e-3, 1e-4, 1e-5}) {
    Random random(7);
    for (int round = 0; round < 100; round++) {
      Transform pose = test::randomPose(random, 1);
      for (Vec3 half : {Vec3{1, 1, thin}, Vec3{1, thin, thin}}) {
        std::vector<Vec3> points = boxCorners(half);
        for (Vec3& p : points) p = transformPoint(pose, p);
        Result<Hull> hull = buildHull(points);
        ASSERT_TRUE(hull) << thin << ": " << hull.error().message;
        EXPECT_EQ(hull->vertices.size(), 8u);
        EXPECT_NEAR(hull->volume, 8 * half.x * half.y * half.z, 1e-9 * hull->volume + 1e-14);
      }
    }
  }
}

TEST(Hull, EverySizeFromAtomsToStars) {
  for (double size : {1e-60, 1e-12, 1e-3, 1e3, 1e12, 1e60}) {
    Result<Hull> hull = buildHull(boxCorners({size, size, size}));
    ASSERT_TRUE(hull) << hull.error().message;
    EXPECT_EQ(hull->planes.size(), 6u);
    EXPECT_NEAR(hull->volume / (8 * size * size * size), 1, 1e-12);
  }
}

TEST(Hull, BadInputIsNamed) {
  double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  std::vector<Vec3> box = boxCorners({1, 1, 1});
  expectError({}, ErrorCode::badGeometry, "found 0 points");
  expectError({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, ErrorCode::badGeometry, "found 3 points");
  for (double bad : {nan, infinite, -infinite}) {
    std::vector<Vec3> points = box;
    points[5].y = bad;
    expectError(points, ErrorCode::invalidArgument, "vertices[5]");
  }
  expectError({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, ErrorCode::badGeometry, "size of 0");
  expectError({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {0.5, 0.5, 0.5}}, ErrorCode::badGeometry, "on a line");
  expectError({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}, {0.5, 0.5, 1}}, ErrorCode::badGeometry, "in a plane");
  expectError({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 1e-8}}, ErrorCode::badGeometry, "in a plane");
  expectError({{1e308, 0, 0}, {-1e308, 0, 0}, {0, 1e308, 0}, {0, 0, 1e308}}, ErrorCode::badGeometry, "size");
  for (Vec3& p : box) p += Vec3{1e9, 0, 0};
  expectError(box, ErrorCode::badGeometry, "from the origin");
  expectError(std::vector<Vec3>(5000, Vec3{1, 2, 3}), ErrorCode::limitExceeded, "found 5000 points");
}

TEST(Hull, AtMostSixtyFourCorners) {
  Random random(8);
  expectHull(prism(32, 1, 1), 64, 34, buildHull(prism(32, 1, 1))->volume);
  expectError(prism(33, 1, 1), ErrorCode::limitExceeded, "66 corners");
  std::vector<Vec3> points = randomPoints(random, 65, {1, 1, 1}, true);
  expectError(points, ErrorCode::limitExceeded, "65 corners");
  points.pop_back();
  EXPECT_TRUE(buildHull(points));
  expectError(randomPoints(random, 4096, {1, 1, 1}, true), ErrorCode::limitExceeded, "4096 corners");
}

TEST(HullValidate, FindsWhatWasBroken) {
  Result<Hull> built = buildHull(boxCorners({1, 2, 3}));
  ASSERT_TRUE(built);
  auto expectFault = [&](auto breakIt) {
    Hull hull = *built;
    breakIt(hull);
    EXPECT_NE(validate(hull), "");
  };
  expectFault([](Hull& h) { h.vertices.pop_back(); });
  expectFault([](Hull& h) { h.vertices[3] *= 1.01; });
  expectFault([](Hull& h) { h.vertices[3] *= 0.99; });
  expectFault([](Hull& h) { h.vertices[3].x = std::numeric_limits<double>::quiet_NaN(); });
  expectFault([](Hull& h) { h.planes[2].normal *= 1.001; });
  expectFault([](Hull& h) { h.planes[2].offset += 0.01; });
  expectFault([](Hull& h) { h.planes[2].offset -= 0.01; });
  expectFault([](Hull& h) { h.edges[5].next = h.edges[7].next; });
  expectFault([](Hull& h) { h.edges[5].origin ^= 1; });
  expectFault([](Hull& h) { h.edges[5].face ^= 1; });
  expectFault([](Hull& h) { h.edges[5].next = 5; });
  expectFault([](Hull& h) { h.edges[5].next = 999; });
  expectFault([](Hull& h) { h.firstEdge[1] = 999; });
  expectFault([](Hull& h) { h.volume = 0; });
  expectFault([](Hull& h) { h.centroid = {5, 5, 5}; });
}

}  // namespace
}  // namespace brickfall
