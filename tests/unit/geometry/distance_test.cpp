// Distance, depth and time of impact against slow methods: every corner, edge and face of both; Qhull on the Minkowski
// difference; bisection.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "geometry/queries.h"
#include "qhull_oracle.h"
#include "shape_samples.h"

namespace brickfall {
namespace {

using test::Outline;
using test::outlineOf;

constexpr ShapeType kSolids[] = {ShapeType::box, ShapeType::sphere, ShapeType::capsule, ShapeType::hull};

Shape coreOf(Shape shape) {
  if (shape.type == ShapeType::sphere || shape.type == ShapeType::capsule) shape.radius = 0;
  return shape;
}

struct Reference {
  double distance = 1e300;  // of the cores
  bool edges = false;       // attained by two edges, not by a corner
};

// Exact where the cores are apart.
Reference referenceDistance(const Shape& a, const Shape& b, const Transform& bInA) {
  Outline outlineA = outlineOf(a), outlineB = outlineOf(b);
  Shape coreA = coreOf(a), coreB = coreOf(b);
  Transform aInB = inverse(bInA);
  Reference best;
  for (Vec3 c : outlineB.corners) {
    Vec3 p = transformPoint(bInA, c);
    best.distance = std::min(best.distance, length(p - closestPoint(coreA, p)));
  }
  for (Vec3 c : outlineA.corners) {
    Vec3 p = transformPoint(aInB, c);
    best.distance = std::min(best.distance, length(p - closestPoint(coreB, p)));
  }
  for (auto [c, d] : outlineB.edges) {
    Vec3 start = transformPoint(bInA, c), end = transformPoint(bInA, d);
    for (auto [p, q] : outlineA.edges) {
      double distance = test::segmentDistance(p, q, start, end);
      if (distance < best.distance - 1e-12) best.distance = distance, best.edges = true;
    }
  }
  return best;
}

void expectWitness(const Shape& a, const Shape& b, const Transform& bInA, const DistanceResult& d) {
  EXPECT_NEAR(length(d.onB - d.onA), d.distance, 1e-12);
  EXPECT_LE(length(closestPoint(a, d.onA) - d.onA), 1e-6);
  Vec3 local = transformPoint(inverse(bInA), d.onB);
  EXPECT_LE(length(closestPoint(b, local) - local), 1e-6);
}

TEST(Distance, AgreesWithEveryCornerAndEdge) {
  test::ShapeSamples samples(1);
  std::map<std::string, int> seen;
  for (int round = 0; round < 24000; round++) {
    Shape a = samples.make(kSolids[round % 4]), b = samples.make(kSolids[round / 4 % 4]);
    Transform pose = test::randomPose(samples.random(), round % 7 == 0 ? 50 : 1.6);
    if (round % 11 == 0) pose.rotation = {};  // parallel faces and edges
    SCOPED_TRACE("round " + std::to_string(round));
    DistanceResult found = shapeDistance(a, b, pose);
    double size = std::max(outerRadius(a, {}), outerRadius(b, {})), depth = penetrationDepth(a, b, pose);
    Reference reference = referenceDistance(a, b, pose);
    double radii = outlineOf(a).radius + outlineOf(b).radius;
    if (found.distance > 0) {
      EXPECT_NEAR(found.distance, reference.distance - radii, 1e-10 * size);
      expectWitness(a, b, pose, found);
      EXPECT_EQ(depth, 0);
      seen[found.distance > 5 ? "far" : reference.edges ? "edges" : "corner"]++;
    } else {
      EXPECT_GE(depth, 0);
      EXPECT_LE(reference.distance - radii, depth + 1e-10);
      seen["overlap"]++;
    }
    DistanceResult swapped = shapeDistance(b, a, inverse(pose));
    EXPECT_NEAR(swapped.distance, found.distance, 1e-11);
    EXPECT_NEAR(penetrationDepth(b, a, inverse(pose)), depth, 1e-11);
  }
  for (const char* regime : {"far", "edges", "corner", "overlap"}) EXPECT_GT(seen[regime], 1000) << regime;
}

// Bricks as they lie in a wall: nearly parallel faces, small gaps, flat and long shapes, where simplices degenerate.
TEST(Distance, NearlyParallelAndThinBoxes) {
  test::ShapeSamples samples(7);
  int apart = 0;
  for (int round = 0; round < 20000; round++) {
    auto power = [&](int most) {
      double value = 1;
      for (int k = int(samples.random().below(std::uint32_t(most))); k > 0; k--) value *= 0.1;
      return value;
    };
    Shape a, b;
    a.halfExtents = {power(4), power(4), power(4)};
    b.halfExtents = {power(4), power(4), power(4)};
    if (round % 2) b = samples.makeHull(outlineOf(b).corners);
    Vec3 offset = scaled(test::randomVector(samples.random(), 2), a.halfExtents);
    offset.y = a.halfExtents.y + (round % 2 ? outlineOf(b).corners[7].y : b.halfExtents.y) + 0.1 * power(10);
    Transform pose{offset, quatFromRotationVector(test::randomDirection(samples.random()) * (0.1 * power(16)))};
    DistanceResult found = shapeDistance(a, b, pose);
    if (!(found.distance > 0)) continue;
    apart++;
    EXPECT_NEAR(found.distance, referenceDistance(a, b, pose).distance, 1e-12) << "round " << round;
    expectWitness(a, b, pose, found);
  }
  EXPECT_GT(apart, 10000);
}

// Brought together along the closest points until a known gap or overlap is left, from 1e-12 m up.
TEST(Distance, NearTouchingIsContinuous) {
  test::ShapeSamples samples(2);
  int checked = 0;
  for (int round = 0; round < 8000; round++) {
    Shape a = samples.make(kSolids[round % 4]), b = samples.make(kSolids[round / 4 % 4]);
    Transform pose = test::randomPose(samples.random(), 3);
    DistanceResult apart = shapeDistance(a, b, pose);
    if (apart.distance < 0.1) continue;
    checked++;
    Vec3 normal = (apart.onB - apart.onA) * (1 / apart.distance);
    for (double gap : {1e-3, 1e-6, 1e-9, 1e-12, 0.0, -1e-12, -1e-9, -1e-6, -1e-3}) {
      Transform near{pose.position - normal * (apart.distance - gap), pose.rotation};
      double distance = shapeDistance(a, b, near).distance, depth = penetrationDepth(a, b, near);
      SCOPED_TRACE("round " + std::to_string(round) + " gap " + std::to_string(gap * 1e12) + "e-12");
      if (gap >= 0) {
        EXPECT_NEAR(distance, gap, 1e-12);
        EXPECT_LE(depth, 1e-12);
        continue;
      }
      // Two sharp corners that met tip to tip slide past each other; anything else is now in overlap.
      EXPECT_LE(std::max(distance, depth), -gap + 1e-12);
      EXPECT_TRUE(distance < 1e-12 || depth < 1e-12);
      bool corners = kSolids[round % 4] != ShapeType::sphere && kSolids[round / 4 % 4] != ShapeType::sphere;
      EXPECT_TRUE(corners || distance == 0);
    }
  }
  EXPECT_GT(checked, 3000);
}

// The depth is the distance from the origin to the border of the Minkowski difference, whose hull Qhull builds.
TEST(Penetration, AgreesWithTheMinkowskiDifference) {
  test::ShapeSamples samples(3);
  std::map<std::string, int> seen;
  for (int round = 0; round < 6000; round++) {
    Shape a = samples.make(kSolids[round % 4]), b = samples.make(kSolids[round / 4 % 4]);
    Outline outlineA = outlineOf(a), outlineB = outlineOf(b);
    if (outlineA.corners.size() * outlineB.corners.size() < 8) continue;  // no volume: closed forms, tested below
    Transform pose = test::randomPose(samples.random(), 0.5);
    if (shapeDistance(coreOf(a), coreOf(b), pose).distance > 0) continue;
    std::vector<Vec3> difference;
    for (Vec3 p : outlineA.corners) {
      for (Vec3 q : outlineB.corners) difference.push_back(p - transformPoint(pose, q));
    }
    test::QhullAnswer oracle = test::qhull(difference);
    double radii = outlineA.radius + outlineB.radius, depth = penetrationDepth(a, b, pose);
    SCOPED_TRACE("round " + std::to_string(round));
    EXPECT_NEAR(depth, std::max(oracle.leastDepth, 0.0) + radii, 1e-9);
    auto isFaceNormal = [&](const Shape& shape, Vec3 n) {
      double most = 0;
      for (int k = 0; k < 3 && shape.type == ShapeType::box; k++) most = std::max(most, std::fabs(n[k]));
      if (shape.type == ShapeType::hull) {
        for (const HullPlane& plane : shape.hull->planes) most = std::max(most, std::fabs(dot(n, plane.normal)));
      }
      return most > 1 - 1e-10;
    };
    Vec3 normalInB = rotate(conjugate(pose.rotation), oracle.leastNormal);
    bool face = isFaceNormal(a, oracle.leastNormal) || isFaceNormal(b, normalInB);
    seen[face ? "face" : "edges"]++;
    if (depth > 0.3 * std::min(innerRadius(a), innerRadius(b))) seen["deep"]++;
  }
  EXPECT_GT(seen["face"], 800);
  EXPECT_GT(seen["edges"], 100);
  EXPECT_GT(seen["deep"], 500);
}

TEST(Penetration, RoundShapesInClosedForm) {
  Shape sphere, capsule;
  sphere.type = ShapeType::sphere, sphere.radius = 0.5;
  capsule.type = ShapeType::capsule, capsule.radius = 0.25, capsule.halfHeight = 1;
  EXPECT_NEAR(penetrationDepth(sphere, sphere, {{0.6, 0, 0}, {}}), 0.4, 1e-15);
  EXPECT_NEAR(penetrationDepth(sphere, sphere, {}), 1, 1e-15);
  EXPECT_EQ(penetrationDepth(sphere, sphere, {{1.1, 0, 0}, {}}), 0);
  EXPECT_NEAR(penetrationDepth(capsule, sphere, {{0.3, 0.7, 0.4}, {}}), 0.25, 1e-15);
  EXPECT_NEAR(penetrationDepth(capsule, sphere, {{0, 1.5, 0}, {}}), 0.25, 1e-15);
  // Crossing capsules: along the common normal of the axes nothing but the radii has to be left behind.
  Quat lying = quatFromAxisAngle({0, 0, 1}, 1.57079632679489661923);
  EXPECT_NEAR(penetrationDepth(capsule, capsule, {{0, 0.2, 0}, lying}), 0.5, 1e-15);
  EXPECT_NEAR(penetrationDepth(capsule, capsule, {{0.1, 0.2, 0.3}, lying}), 0.2, 1e-15);
  EXPECT_NEAR(penetrationDepth(capsule, capsule, {{0.1, 0.2, 0}, {}}), 0.4, 1e-15);
}

TEST(Distance, PlanesAreHalfSpaces) {
  test::ShapeSamples samples(4);
  Shape plane;
  plane.type = ShapeType::plane;
  int below = 0, above = 0;
  for (int round = 0; round < 4000; round++) {
    Shape shape = samples.make(kSolids[round % 4]);
    Transform pose = test::randomPose(samples.random(), 1.5);
    Outline outline = outlineOf(shape);
    double lowest = 1e300;
    for (Vec3 c : outline.corners) lowest = std::min(lowest, transformPoint(pose, c).y - outline.radius);
    DistanceResult found = shapeDistance(plane, shape, pose), swapped = shapeDistance(shape, plane, inverse(pose));
    EXPECT_NEAR(found.distance, std::max(lowest, 0.0), 1e-14);
    EXPECT_NEAR(swapped.distance, found.distance, 1e-13);
    EXPECT_NEAR(penetrationDepth(plane, shape, pose), std::max(-lowest, 0.0), 1e-14);
    EXPECT_NEAR(penetrationDepth(shape, plane, inverse(pose)), std::max(-lowest, 0.0), 1e-13);
    if (lowest > 0) expectWitness(plane, shape, pose, found);
    if (lowest > 0) expectWitness(shape, plane, inverse(pose), swapped);
    lowest > 0 ? above++ : below++;
  }
  EXPECT_GT(below, 1000);
  EXPECT_GT(above, 1000);
  EXPECT_EQ(shapeDistance(plane, plane, {{0, 5, 0}, {}}).distance, 0);
  EXPECT_EQ(penetrationDepth(plane, plane, {{0, -5, 0}, {}}), 0);
  EXPECT_FALSE(timeOfImpact(plane, plane, {}, {0, -1, 0}, 0));
}

// First time at which the distance, a convex function of time, is at most `near`; < 0: never.
double bisectedTime(const Shape& a, const Shape& b, const Transform& bInA, Vec3 motion, double near) {
  auto distance = [&](double t) { return shapeDistance(a, b, {bInA.position + motion * t, bInA.rotation}).distance; };
  if (distance(0) <= near) return 0;
  double low = 0, high = 1;  // golden section would be faster; thirds are simpler
  for (int k = 0; k < 200 && distance(high) > near; k++) {
    double t1 = low + (high - low) / 3, t2 = high - (high - low) / 3;
    (distance(t1) <= distance(t2) ? high : low) = distance(t1) <= distance(t2) ? t2 : t1;
  }
  if (distance(high) > near) return -1;
  low = 0;
  for (int k = 0; k < 100; k++) (distance(0.5 * (low + high)) <= near ? high : low) = 0.5 * (low + high);
  return high;
}

TEST(TimeOfImpact, AgreesWithBisection) {
  test::ShapeSamples samples(5);
  int hits = 0, misses = 0, starts = 0;
  for (int round = 0; round < 6000; round++) {
    ShapeType types[] = {ShapeType::box, ShapeType::sphere, ShapeType::capsule, ShapeType::hull, ShapeType::plane};
    Shape a = samples.make(types[round % 5]), b = samples.make(types[round / 5 % 4]);
    Transform pose = test::randomPose(samples.random(), 3);
    Vec3 motion = test::randomVector(samples.random(), 1) * 1.5 - pose.position * samples.random().between(-0.5, 3);
    double target = round % 3 == 0 ? 0 : samples.random().between(0, 0.2);
    SCOPED_TRACE("round " + std::to_string(round));
    auto time = timeOfImpact(a, b, pose, motion, target);
    double expected = bisectedTime(a, b, pose, motion, target + 1e-6), sure = bisectedTime(a, b, pose, motion, target);
    if (time) {
      ASSERT_GE(expected, 0);
      *time == 0 ? starts++ : hits++;
      DistanceResult there = shapeDistance(a, b, {pose.position + motion * *time, pose.rotation});
      EXPECT_LE(there.distance, target + 1.001e-6);
      EXPECT_GE(*time, expected - 1e-9);
      EXPECT_TRUE(sure < 0 || *time <= sure + 1e-9);
    } else {
      misses++;
      EXPECT_LT(sure, 0);
    }
  }
  EXPECT_GT(hits, 1500);
  EXPECT_GT(misses, 1000);
  EXPECT_GT(starts, 300);
}

// A bullet through a thin board at a thousand times its thickness a step.
TEST(TimeOfImpact, FastBallNeverPassesAThinBoard) {
  test::ShapeSamples samples(6);
  Shape board, ball;
  board.halfExtents = {2, 2, 0.0005};
  ball.type = ShapeType::sphere;
  ball.radius = 0.001;
  for (int round = 0; round < 2000; round++) {
    Vec3 through = test::randomVector(samples.random(), 1.9);
    through.z = 0;
    Vec3 direction = test::randomDirection(samples.random());
    if (std::fabs(direction.z) < 1e-3) continue;
    auto time = timeOfImpact(board, ball, {through - direction * 500.0, {}}, direction * 1000.0, 0);
    ASSERT_TRUE(time) << round;
    double expected = 0.5 - 0.0015 / std::fabs(direction.z) / 1000;
    if (std::fabs(direction.z) > 0.05) {
      EXPECT_NEAR(*time, expected, 2.2e-8);
    }
  }
}

}  // namespace
}  // namespace brickfall
