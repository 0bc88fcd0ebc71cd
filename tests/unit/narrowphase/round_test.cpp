// Spheres and capsules against everything, checked by distances found another way.
#include <gtest/gtest.h>

#include <algorithm>

#include "contact_checks.h"

namespace brickfall {
namespace {

using namespace test;

// Least value of a convex function on [0, 1], by golden section.
template <class F> double leastOf(F f) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; i++) {
    double a = low + 0.381966 * (high - low), b = low + 0.618034 * (high - low);
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return f(0.5 * (low + high));
}

double distanceFromSegment(Vec3 p, double halfHeight) {
  return length(p - Vec3{0, std::clamp(p.y, -halfHeight, halfHeight), 0});
}

TEST(Sphere, AgainstEverythingByDistance) {
  Random random(1);
  constexpr double kMargin = 0.02;
  int contacts[4] = {}, inside = 0;
  for (int i = 0; i < 8000; i++) {
    int kind = i % 4;
    Hull hull = randomHull(random, 9);
    double radius = random.between(0.03, 0.2);
    Shape sphere = sphereShape(radius), other = kind == 0 ? sphereShape(random.between(0.03, 0.3))
                                                : kind == 1
                                                    ? capsuleShape(random.between(0.03, 0.2), random.between(0.05, 0.3))
                                                : kind == 2 ? boxShape(randomHalfExtents(random))
                                                            : hullShape(hull);
    Transform pose{randomDirection(random) * random.between(0.02, 0.6), randomRotation(random)};
    Vec3 centre = transformPoint(inverse(pose), Vec3{});
    double distance = 0;
    if (kind == 0) distance = length(centre) - other.radius;
    if (kind == 1) distance = distanceFromSegment(centre, other.halfHeight) - other.radius;
    if (kind >= 2) distance = distanceByGjk(other, centre);
    Manifold m;
    collide(sphere, other, pose, kMargin, m);
    ASSERT_EQ(faultOf(m, sphere, other, pose, kMargin, 1e-9), "") << i;
    if (kind < 2 || distance > 1e-6) {
      ASSERT_EQ(m.count, distance - radius <= kMargin ? 1 : 0) << i;
      ASSERT_TRUE(m.count == 0 || std::fabs(m.points[0].separation - (distance - radius)) < 1e-8) << i;
    }
    if (kind >= 2 && distance == 0) {  // the centre is inside: out through the nearest face
      double nearest = 1e30;
      for (Vec3 n : faceNormalsOf(other, {})) {
        double support = -1e30;
        for (Vec3 p : cornersOf(other, {})) support = std::max(support, dot(p, n));
        nearest = std::min(nearest, support - dot(centre, n));
      }
      ASSERT_EQ(m.count, 1);
      ASSERT_NEAR(m.points[0].separation, -nearest - radius, 1e-8);
      inside++;
    }
    contacts[kind] += m.count;
    Manifold back = swapped(sphere, other, pose, kMargin);
    ASSERT_EQ(back.count, m.count);
    if (m.count) {
      ASSERT_LT(length(back.points[0].onB - m.points[0].onB), 1e-12);
      ASSERT_LT(length(back.normal - m.normal), 1e-9);
    }
  }
  for (int count : contacts) EXPECT_GT(count, 500);
  EXPECT_GT(inside, 20);
}

TEST(Sphere, ConcentricAndOnTheAxisStillHaveANormal) {
  Manifold m;
  collide(sphereShape(1), sphereShape(0.5), {}, 0, m);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(faultOf(m, sphereShape(1), sphereShape(0.5), {}, 0, 1e-12), "");
  EXPECT_DOUBLE_EQ(m.points[0].separation, -1.5);
  collide(sphereShape(1), capsuleShape(0.5, 1), {{0, 0.3, 0}, {}}, 0, m);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(faultOf(m, sphereShape(1), capsuleShape(0.5, 1), {{0, 0.3, 0}, {}}, 0, 1e-12), "");
  collide(sphereShape(0.1), boxShape({1, 1, 1}), {}, 0, m);
  ASSERT_EQ(m.count, 1);
  EXPECT_DOUBLE_EQ(m.points[0].separation, -1.1);
}

// The distance of a capsule's axis from another shape: a convex function along the axis.
double axisDistance(const Shape& capsule, const Shape& other, const Transform& pose) {
  Transform inOther = inverse(pose);
  return leastOf([&](double t) {
    Vec3 p = transformPoint(inOther, Vec3{0, (2 * t - 1) * capsule.halfHeight, 0});
    if (other.type == ShapeType::capsule) return distanceFromSegment(p, other.halfHeight) - other.radius;
    if (other.type == ShapeType::box) return length(max(abs(p) - other.halfExtents, Vec3{}));
    return distanceByGjk(other, p);
  });
}

TEST(Capsule, AgainstEverythingByDistance) {
  Random random(6);
  constexpr double kMargin = 0.02;
  int contacts[3] = {}, two[3] = {}, through = 0;
  for (int i = 0; i < 6000; i++) {
    int kind = i % 3;
    Hull hull = randomHull(random, 9);
    Shape capsule = capsuleShape(random.between(0.03, 0.1), random.between(0.05, 0.3));
    Shape other = kind == 0   ? capsuleShape(random.between(0.03, 0.1), random.between(0.05, 0.3))
                  : kind == 1 ? boxShape(randomHalfExtents(random))
                              : hullShape(hull);
    Transform pose{randomDirection(random) * random.between(0.05, 0.5), randomRotation(random)};
    if (i % 4 == 0) pose.rotation = quatFromRotationVector(randomDirection(random) * random.between(0, 0.02));
    double distance = axisDistance(capsule, other, pose), separation = distance - capsule.radius;
    Manifold m;
    collide(capsule, other, pose, kMargin, m);
    ASSERT_EQ(faultOf(m, capsule, other, pose, kMargin, 3e-3), "") << i;
    if (kind > 0 && distance < 1e-6) {
      // The axis runs through: pushing by the depth along the normal parts axis and shape, along nothing much less.
      through++;
      ASSERT_GT(m.count, 0);
      Transform pushed = pose;
      pushed.position += m.normal * (-deepest(m) - capsule.radius + 1e-4 + 1.1e-3);
      ASSERT_GT(axisDistance(capsule, other, pushed), 0) << i;
      continue;
    }
    if (kind == 0 && separation < -0.9 * other.radius) continue;
    ASSERT_EQ(m.count > 0, separation <= kMargin) << i << " " << separation;
    if (m.count == 0) continue;
    contacts[kind]++;
    two[kind] += m.count == 2;
    ASSERT_NEAR(deepest(m), separation, 0.02 * capsule.radius) << i;
    Manifold back = swapped(capsule, other, pose, kMargin);
    ASSERT_EQ(back.count > 0, true);
    ASSERT_NEAR(deepest(back), deepest(m), 0.02 * capsule.radius);
    ASSERT_GT(dot(back.normal, m.normal), 0.99);
  }
  EXPECT_GT(contacts[0], 400);
  EXPECT_GT(contacts[1], 400);
  EXPECT_GT(contacts[2], 400);
  EXPECT_GT(two[0], 50);
  EXPECT_GT(two[1], 50);
  EXPECT_GT(through, 100);
}

TEST(Capsule, LyingOnABoxTouchesWithTwoPoints) {
  Shape capsule = capsuleShape(0.05, 0.2), box = boxShape({0.15, 0.1, 0.3});
  Quat lying = quatFromAxisAngle({0, 0, 1}, 1.5707963267948966);
  // In the frame of the box: along x, 1 mm above its top, sticking out at both ends.
  for (double tilt : {-0.01, 0.0, 0.01}) {
    Transform capsuleInBox{{0, 0.151, 0}, quatFromAxisAngle({0, 0, 1}, tilt) * lying};
    Manifold m;
    collide(box, capsule, capsuleInBox, 0.01, m);
    ASSERT_EQ(m.count, 2) << tilt;
    EXPECT_GT(m.normal.y, 1 - 1e-9);
    EXPECT_NEAR(std::fabs(m.points[0].onA.x - m.points[1].onA.x), 0.3, 1e-6);
    EXPECT_NEAR(0.5 * (m.points[0].separation + m.points[1].separation), 0.001, 1e-4);
  }
}

TEST(Capsule, SideBySideTouchAlongTheCommonStretch) {
  Shape a = capsuleShape(0.05, 0.2), b = capsuleShape(0.05, 0.1);
  Manifold m;
  collide(a, b, {{0.1, 0.15, 0}, {}}, 0.01, m);
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(m.normal.x, 1, 1e-12);
  double low = std::min(m.points[0].onA.y, m.points[1].onA.y), high = std::max(m.points[0].onA.y, m.points[1].onA.y);
  EXPECT_NEAR(low, 0.05, 1e-12);
  EXPECT_NEAR(high, 0.2, 1e-12);
}

}  // namespace
}  // namespace brickfall
