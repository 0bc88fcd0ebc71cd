// The ground: every shape against a plane, where the answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "contact_checks.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Plane, ShapesRestOnTheGround) {
  Shape plane = planeShape();
  Manifold m;
  collide(plane, sphereShape(0.1), {{3, 0.09, -2}, {}}, 0.01, m);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, (Vec3{0, 1, 0}));
  EXPECT_NEAR(m.points[0].separation, -0.01, 1e-15);
  EXPECT_EQ(m.points[0].onA, (Vec3{3, 0, -2}));

  collide(plane, boxShape({0.1, 0.03, 0.05}), {{1, 0.031, 0}, {}}, 0.01, m);
  ASSERT_EQ(m.count, 4);
  for (const ManifoldPoint& p : m.points) {
    EXPECT_NEAR(p.separation, 0.001, 1e-15);
    EXPECT_NEAR(std::fabs(p.onB.x - 1), 0.1, 1e-15);
    EXPECT_NEAR(std::fabs(p.onB.z), 0.05, 1e-15);
  }

  Transform lying{{0, 0.05, 0}, quatFromAxisAngle({0, 0, 1}, 1.5707963267948966)};
  collide(plane, capsuleShape(0.05, 0.2), lying, 0.01, m);
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(std::fabs(m.points[0].onA.x - m.points[1].onA.x), 0.4, 1e-12);
  collide(plane, capsuleShape(0.05, 0.2), {{0, 0.25, 0}, {}}, 0.01, m);
  EXPECT_EQ(m.count, 1);
}

TEST(Plane, TwoPlanesNeverTouch) {
  Manifold m;
  m.count = 3;
  collide(planeShape(), planeShape(), {}, 0.01, m);
  EXPECT_EQ(m.count, 0);
}

TEST(Plane, FlatHullOfManyCornersKeepsFourAroundIt) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 12; i++) {
    double s, c;
    sinCos(i * 0.5235987755982988, s, c);
    corners.push_back({0.2 * c, 0, 0.2 * s});
    corners.push_back({0.2 * c, 0.1, 0.2 * s});
  }
  Hull hull = buildHull(corners).value();
  Manifold m;
  collide(planeShape(), hullShape(hull), {}, 0.01, m);
  ASSERT_EQ(m.count, 4);
  double area = 0;
  for (int k = 0; k < 4; k++) {
    Vec3 p = m.points[k].onA, q = m.points[(k + 1) % 4].onA;
    area += 0.5 * (p.x * q.z - q.x * p.z);
  }
  EXPECT_NEAR(std::fabs(area), 0.08, 1e-9);  // the inscribed square: the largest there is
}

// A drum of twelve corners, tipped by so little that the corner 0 is the deepest by micrometres.
TEST(Plane, PointsThatCarryStayWhileTheyExist) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 12; i++) {
    double s, c;
    sinCos(i * 0.5235987755982988, s, c);
    for (double y : {0.0, 0.1}) corners.push_back({0.2 * c, y, 0.2 * s});
  }
  Hull hull = buildHull(corners).value();
  auto pointsAt = [&](double tilt, const LoadedPoints& loaded) {
    Manifold m;
    collide(planeShape(), hullShape(hull), {{}, quatFromAxisAngle({0, 0, 1}, tilt)}, 0.01, m, loaded);
    std::set<std::uint32_t> features;
    for (const ManifoldPoint& p : m.points) features.insert(p.feature);
    EXPECT_EQ(m.count, 4);
    EXPECT_TRUE(m.partial);
    return features;
  };
  const std::set<std::uint32_t> right = pointsAt(-1e-5, {}), left = pointsAt(1e-5, {});
  LoadedPoints all, two;
  for (std::uint32_t feature : left) all.add(feature);
  EXPECT_EQ(pointsAt(-1e-5, all), left) << "all that carried";
  for (std::uint32_t feature : pointsAt(0.01, {}))
    if (!right.count(feature) && two.count < 2) two.add(feature);
  const std::set<std::uint32_t> kept = pointsAt(-1e-5, two);
  for (int i = 0; i < two.count; i++) EXPECT_TRUE(kept.count(two.features[i])) << "and room for others";
  LoadedPoints gone;
  gone.add(12345);
  EXPECT_EQ(pointsAt(-1e-5, gone), right) << "what is no corner any more asks for nothing";
}

TEST(Plane, RandomPosesAgainstAllCorners) {
  Random random(4);
  Shape plane = planeShape();
  int four = 0, contacts = 0;
  for (int i = 0; i < 6000; i++) {
    Hull hull = randomHull(random, 12);
    Shape shape = i % 2 ? boxShape(randomHalfExtents(random)) : hullShape(hull);
    Transform pose{{random.between(-1, 1), random.between(0, 0.3), random.between(-1, 1)}, randomRotation(random)};
    if (i % 3 == 0) {  // a face down
      Vec3 n = faceNormalsOf(shape, pose)[0], axis = cross(n, Vec3{0, -1, 0});
      pose.rotation = quatFromAxisAngle(normalized(axis), std::atan2(length(axis), -n.y)) * pose.rotation;
    }
    double lowest = 1e30;
    for (Vec3 p : cornersOf(shape, pose)) lowest = std::min(lowest, p.y);
    Manifold m;
    collide(plane, shape, pose, 0.01, m);
    ASSERT_EQ(faultOf(m, plane, shape, pose, 0.01, 1e30), "");
    ASSERT_EQ(m.count > 0, lowest <= 0.01);
    if (m.count == 0) continue;
    contacts++;
    ASSERT_NEAR(deepest(m), lowest, 2e-5);
    four += m.count == 4;
    Manifold back = swapped(plane, shape, pose, 0.01);
    ASSERT_EQ(back.count, m.count);
    ASSERT_GT(dot(back.normal, m.normal), 1 - 1e-12);
    for (int k = 0; k < m.count; k++) ASSERT_LT(length(back.points[k].onB - m.points[k].onB), 1e-12);
  }
  EXPECT_GT(contacts, 2000);
  EXPECT_GT(four, 200);
}

}  // namespace
}  // namespace brickfall
