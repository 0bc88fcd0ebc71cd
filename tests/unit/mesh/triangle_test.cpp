// Two triangles, and a triangle and a point.
#include <gtest/gtest.h>

#include <map>

#include "exact_triangles.h"
#include "support/random_geometry.h"

namespace {

using namespace brickfall;
using namespace brickfall::test;

Triangle moved(const Triangle& t, const Transform& pose) {
  Triangle out;
  for (int k = 0; k < 3; k++) out.corner[k] = transformPoint(pose, t.corner[k]);
  return out;
}
double area(const Triangle& t) { return 0.5 * length(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0])); }

Triangle wholeTriangle(Random& random, int limit) {
  for (;;) {
    Triangle t;
    for (Vec3& c : t.corner)
      for (int k = 0; k < 3; k++) c[k] = double(int(random.below(std::uint32_t(2 * limit + 1)))) - limit;
    if (area(t) > 0) return t;
  }
}

// Another triangle on the whole-number lattice of the plane of a.
Triangle inPlaneOf(const Triangle& a, Random& random) {
  for (;;) {
    Triangle t;
    for (Vec3& c : t.corner) {
      double u = double(random.below(9)) - 4, v = double(random.below(9)) - 4;
      c = a.corner[0] + (a.corner[1] - a.corner[0]) * u + (a.corner[2] - a.corner[0]) * v;
    }
    if (area(t) > 0) return t;
  }
}

// Small whole numbers: touching and coplanar pairs are frequent. Larger ones: needles and general pairs.
TEST(Triangles, OverlapAgreesWithExactArithmetic) {
  Random random(1);
  std::map<Meeting, int> met;
  for (int limit : {2, 3, 5, 20, 2000})
    for (int i = 0; i < 60000; i++) {
      Triangle a = wholeTriangle(random, limit), b = wholeTriangle(random, limit);
      if (i % 8 == 0 && limit <= 20) b = inPlaneOf(a, random);
      Meeting meeting = exactMeeting(a, b);
      met[meeting]++;
      bool meets = meeting != Meeting::apart && meeting != Meeting::coplanarApart;
      ASSERT_EQ(trianglesOverlap(a, b), meets) << "limit " << limit << ", pair " << i;
      ASSERT_EQ(trianglesOverlap(b, a), meets) << "limit " << limit << ", pair " << i << " swapped";
    }
  for (Meeting m : {Meeting::apart, Meeting::coplanarApart, Meeting::touch, Meeting::coplanar, Meeting::cross})
    EXPECT_GT(met[m], 1000) << "meeting " << int(m);
}

TEST(Triangles, OverlapKeepsUnderScalingByPowersOfTwo) {
  Random random(2);
  int meeting = 0;
  for (int i = 0; i < 20000; i++) {
    Triangle a = wholeTriangle(random, 4), b = wholeTriangle(random, 4);
    bool meets = trianglesOverlap(a, b);
    meeting += meets;
    for (double scale : {0x1p-60, 0x1p60}) {
      Triangle c = a, d = b;
      for (int k = 0; k < 3; k++) c.corner[k] *= scale, d.corner[k] *= scale;
      ASSERT_EQ(trianglesOverlap(c, d), meets) << i;
    }
  }
  EXPECT_GT(meeting, 4000);
  EXPECT_LT(meeting, 16000);
}

// A gap of ten times the stated tolerance is seen, also between nearly parallel and nearly coplanar triangles; none is seen
// where they overlap by that much.
TEST(Triangles, OverlapIsSharpNearTouching) {
  Random random(3);
  int apart = 0, meeting = 0;
  for (int i = 0; i < 20000; i++) {
    double tilt = i % 2 ? std::pow(10, -random.between(1, 9)) : 0;
    Triangle a{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}};
    Vec3 dip{0, -tilt, 0};
    // b beside a's longest edge, its own edge along it, tilted downwards away from it.
    for (double gap : {1e-12, -1e-12}) {
      Vec3 out = normalized(Vec3{1, 0, 1});
      Vec3 p = Vec3{0.7, 0, 0.3} + out * gap, q = Vec3{0.3, 0, 0.7} + out * gap;
      Triangle b{{p, q, (p + q) * 0.5 + out * 0.5 + dip}};
      bool meets = trianglesOverlap(a, b);
      (meets ? meeting : apart)++;
      ASSERT_EQ(meets, gap < 0) << "tilt " << tilt;
    }
  }
  EXPECT_EQ(apart, 20000);
  EXPECT_EQ(meeting, 20000);
}

// The nearest of a fine grid of point pairs is no nearer, and the points found are where they should be.
TEST(Triangles, DistanceIsTheLeastAndItsPointsAreOnThem) {
  Random random(4);
  int apart = 0, meeting = 0;
  for (int i = 0; i < 4000; i++) {
    Triangle a, b;
    for (Vec3& c : a.corner) c = randomVector(random, 1);
    for (Vec3& c : b.corner) c = randomVector(random, 1) + Vec3{random.between(0, 2), 0, 0};
    TriangleDistance d = triangleDistance(a, b), swapped = triangleDistance(b, a);
    ASSERT_NEAR(d.distance, swapped.distance, 1e-12);
    ASSERT_NEAR(length(d.onB - d.onA), d.distance, 1e-12);
    ASSERT_LT(length(closestPoint(a, d.onA).point - d.onA), 1e-12);
    ASSERT_LT(length(closestPoint(b, d.onB).point - d.onB), 1e-12);
    ASSERT_EQ(d.distance == 0, trianglesOverlap(a, b));
    (d.distance == 0 ? meeting : apart)++;
    double least = 1e30;
    for (int u = 0; u <= 12; u++)
      for (int v = 0; u + v <= 12; v++) {
        Vec3 p = a.corner[0] + (a.corner[1] - a.corner[0]) * (u / 12.0) + (a.corner[2] - a.corner[0]) * (v / 12.0);
        least = std::min(least, length(closestPoint(b, p).point - p));
      }
    ASSERT_LE(d.distance, least + 1e-12);
    ASSERT_GE(d.distance, least - 0.25) << "further than any grid point can be";
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(meeting, 200);
}

TEST(Triangles, DistanceOfDegenerateConfigurations) {
  Triangle a{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}};
  // Parallel, one above the other; coplanar beside each other; edge to edge in line; the same triangle.
  EXPECT_NEAR(triangleDistance(a, moved(a, {{0.1, 0.25, 0.1}, {}})).distance, 0.25, 1e-15);
  EXPECT_NEAR(triangleDistance(a, moved(a, {{2, 0, 0}, {}})).distance, 1, 1e-15);
  EXPECT_NEAR(triangleDistance(a, moved(a, {{0, 0, -2}, {}})).distance, 1, 1e-15);
  EXPECT_EQ(triangleDistance(a, a).distance, 0);
  EXPECT_EQ(triangleDistance(a, moved(a, {{1, 0, 0}, {}})).distance, 0);
}

TEST(Triangles, ClosestPointIsTheLeastOfAGrid) {
  Random random(5);
  int parts[3] = {};
  for (int i = 0; i < 5000; i++) {
    Triangle t;
    for (Vec3& c : t.corner) c = randomVector(random, 1);
    Vec3 p = randomVector(random, 2);
    TrianglePoint found = closestPoint(t, p);
    parts[int(found.part)]++;
    double distance = length(found.point - p);
    for (int u = 0; u <= 10; u++)
      for (int v = 0; u + v <= 10; v++)
        ASSERT_LE(distance, length(t.corner[0] + (t.corner[1] - t.corner[0]) * (u / 10.0) +
                                   (t.corner[2] - t.corner[0]) * (v / 10.0) - p) +
                                1e-12);
    if (found.part == TrianglePart::corner) {
      ASSERT_EQ(found.point, t.corner[found.index]);
    }
    if (found.part == TrianglePart::edge) {
      Vec3 e = t.corner[(found.index + 1) % 3] - t.corner[found.index];
      ASSERT_NEAR(dot(e, p - found.point), 0, 1e-12);
    }
  }
  for (int part : parts) EXPECT_GT(part, 150);
}

}  // namespace
