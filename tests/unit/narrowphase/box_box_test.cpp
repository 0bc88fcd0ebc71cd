// Box against box: the cases a wall is made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "contact_checks.h"

namespace brickfall {
namespace {

using namespace test;

const Vec3 kHalf{0.1075, 0.0325, 0.05125};
const Shape kBrick = boxShape(kHalf);

TEST(BoxBox, BrickOnBrickGivesTheCornersOfTheOverlap) {
  Manifold m;
  collide(kBrick, kBrick, {{0.1075, 0.065, 0}, {}}, 0.01, m);
  ASSERT_EQ(m.count, 4);
  EXPECT_EQ(m.normal, (Vec3{0, 1, 0}));
  std::set<std::uint32_t> names;
  for (const ManifoldPoint& p : m.points) {
    EXPECT_NEAR(p.onA.x, p.onA.x > 0.05 ? 0.1075 : 0.0, 1e-12);
    EXPECT_NEAR(std::fabs(p.onA.z), 0.05125, 1e-12);
    EXPECT_NEAR(p.onA.y, 0.0325, 1e-12);
    EXPECT_NEAR(p.separation, 0, 1e-12);
    names.insert(p.feature);
  }
  EXPECT_EQ(names.size(), 4u);
}

// Tiles turned against each other meet in eight corners.
TEST(BoxBox, PointsThatCarryStayWhileTheyExist) {
  const Shape tile = boxShape({0.1, 0.03, 0.1});
  auto pointsAt = [&](Vec3 axis, const LoadedPoints& loaded) {
    Manifold m;
    const Quat turned = quatFromAxisAngle(normalized(axis), 1e-5) * quatFromAxisAngle({0, 1, 0}, 0.7853981633974483);
    collide(tile, tile, {{0, 0.06, 0}, turned}, 0.01, m, loaded);
    EXPECT_EQ(m.count, 4);
    EXPECT_TRUE(m.partial);
    std::set<std::uint32_t> features;
    for (const ManifoldPoint& p : m.points) features.insert(p.feature);
    return features;
  };
  LoadedPoints loaded;
  const std::set<std::uint32_t> before = pointsAt({1, 0, 0.3}, {});
  for (std::uint32_t feature : before) loaded.add(feature);
  EXPECT_NE(pointsAt({1, 0, -0.7}, {}), before) << "a micrometre decides";
  EXPECT_EQ(pointsAt({1, 0, -0.7}, loaded), before) << "but not about those that carry";
}

TEST(BoxBox, HeadJointTouchesSideways) {
  for (double gap : {-1e-9, 0.0, 1e-9}) {
    Manifold m;
    collide(kBrick, kBrick, {{0.215 + gap, 0, 0}, {}}, 0.01, m);
    ASSERT_EQ(m.count, 4);
    EXPECT_EQ(m.normal, (Vec3{1, 0, 0}));
  }
}

// Two plates that lean on each other along their top edges, `up` m apart in height.
Manifold ridge(double lean, double up, double along = 0) {
  const Shape plate = boxShape({0.01, 0.2, 0.1});
  auto at = [&](int side) {
    Transform pose;
    pose.rotation = quatFromAxisAngle({0, 0, 1}, side * lean);
    pose.position = Vec3{0, side * up / 2, side * along / 2} - rotate(pose.rotation, Vec3{-side * 0.01, 0.2, 0});
    return pose;
  };
  Manifold m;
  collide(plate, plate, inverse(at(-1)) * at(1), 0.01, m);
  m.normal = rotate(at(-1).rotation, m.normal);
  for (ManifoldPoint& p : m.points) p.onA = transformPoint(at(-1), p.onA);
  return m;
}

TEST(BoxBox, EdgeOnEdgeTakesNeitherFacesNormal) {
  for (double lean : {0.2, 0.5, 0.7}) {
    Manifold m = ridge(lean, 0, 0.03);
    ASSERT_EQ(m.count, 2) << lean;
    EXPECT_NEAR(length(m.normal - Vec3{1, 0, 0}), 0, 1e-9) << "by symmetry";
    std::set<double> ends;
    for (int i = 0; i < 2; i++) {
      EXPECT_NEAR(m.points[i].onA.x, 0, 1e-9);
      EXPECT_NEAR(m.points[i].onA.y, 0, 1e-9);
      EXPECT_NEAR(m.points[i].separation, 0, 1e-9);
      ends.insert(std::round(m.points[i].onA.z * 1e9) * 1e-9);
    }
    EXPECT_NEAR(*ends.begin(), -0.085, 1e-8) << "where the edges lie side by side";
    EXPECT_NEAR(*ends.rbegin(), 0.085, 1e-8);
    EXPECT_NE(m.points[0].feature, m.points[1].feature);
  }
}

TEST(BoxBox, EdgesTouchAsFarAsTheyLieSideBySide) {
  Manifold ends = ridge(0.5, 0, 0.195);
  ASSERT_EQ(ends.count, 2);
  EXPECT_NEAR(std::fabs(ends.points[1].onA.z - ends.points[0].onA.z), 0.005, 1e-9);
  for (double apart : {-1e-5, 1e-4, 5e-3}) {  // m, along the ridge: they no longer do, but are within the margin
    Manifold m = ridge(0.5, 0, 0.2 + apart);
    int touching = 0;
    for (int i = 0; i < m.count; i++) touching += m.points[i].separation < apart - 1e-9;
    EXPECT_EQ(touching, 0) << apart;
  }
}

// One edge reaches a little over the face beside the other: each point lay on the surface of one box, and beside the other.
TEST(BoxBox, PointsOfEdgesSideBySideLieOnBothBoxes) {
  const Vec3 halfA{0.377, 0.056, 0.404}, halfB{0.1, 0.206, 0.279};
  const Quat turned = quatFromAxisAngle({0, 1, 0}, -0.37);
  auto beside = [](Vec3 half, Vec3 point) {
    return std::max({std::fabs(point.x) - half.x, std::fabs(point.y) - half.y, std::fabs(point.z) - half.z});
  };
  for (auto [over, deep] : {std::pair{1e-4, 1e-3}, {4e-4, 2e-3}, {6e-4, 4e-3}}) {
    const Vec3 edgeOfB = rotate(turned, Vec3{-halfB.x, 0, -halfB.z});
    const Vec3 place = Vec3{-halfA.x + over, 0, halfA.z - deep} - edgeOfB;
    Manifold m;
    collide(boxShape(halfA), boxShape(halfB), {place, turned}, 0.01, m);
    ASSERT_EQ(m.count, 2) << over;
    EXPECT_GT(m.normal.z, std::cos(0.35)) << "between the normals of both faces";
    EXPECT_LT(m.normal.z, std::cos(0.1));
    for (int i = 0; i < 2; i++) {
      EXPECT_LT(beside(halfA, m.points[i].onA), 1e-9) << over;
      EXPECT_LT(beside(halfB, rotate(conjugate(turned), m.points[i].onB - place)), 1e-9) << over;
    }
  }
}

TEST(BoxBox, EdgeOnEdgeTurnsSmoothlyIntoEdgeOnFace) {
  const double lean = 0.5;
  double before = 0, largest = 0, smallest = 1;
  for (double up = -2e-3; up <= 2e-3; up += 1e-5) {
    Manifold m = ridge(lean, up);
    ASSERT_GE(m.count, 2) << up;
    double angle = std::atan2(m.normal.y, m.normal.x);
    EXPECT_NEAR(m.normal.z, 0, 1e-12);
    if (up > -2e-3) {
      EXPECT_LT(std::fabs(angle - before), 0.08) << up;
    }
    // The right plate higher: its edge is over nothing, the left one's lies on its face.
    if (std::fabs(up) > 1e-3) {
      EXPECT_NEAR(std::fabs(angle), lean, 1e-6) << up;
    }
    before = angle;
    largest = std::max(largest, angle);
    smallest = std::min(smallest, angle);
  }
  EXPECT_NEAR(largest, lean, 1e-6);
  EXPECT_NEAR(smallest, -lean, 1e-6);
}

TEST(BoxBox, DiagonalNeighboursThatShareALineDoNotTouch) {
  for (double dx : {-1e-6, -1e-9, 0.0, 1e-9, 1e-6})
    for (double dy : {-1e-6, -1e-9, 0.0, 1e-9, 1e-6}) {
      Manifold m;
      collide(kBrick, kBrick, {{0.215 + dx, 0.065 + dy, 0}, {}}, 0.01, m);
      EXPECT_EQ(m.count, 0) << dx << " " << dy;
    }
}

// Walls of bricks without gaps, every second course shifted by `shift` of a length: each bed joint carries with four
// points and a vertical normal, each head joint touches with a level one, and nobody else touches. With noise of
// rounding size and more.
TEST(BoxBox, WallsHaveBedAndHeadJointsOnly) {
  Random random(9);
  int beds = 0, heads = 0, lines = 0;
  for (double shift : {0.0, 1.0 / 3, 0.5})
    for (double noise : {0.0, 1e-12, 1e-9, 1e-7, 4e-6})
      for (double turn : {0.0, 0.6457718232379019}) {
        Quat about = quatFromAxisAngle({0, 1, 0}, turn);
        std::vector<Transform> bricks;
        for (int course = 0; course < 5; course++)
          for (int i = 0; i < 4; i++) {
            Vec3 place{2 * kHalf.x * (i + shift * (course % 2)), 2 * kHalf.y * course, 0};
            place += randomVector(random, noise);
            bricks.push_back({rotate(about, place) + Vec3{100, 0, -50},
                              about * quatFromRotationVector(randomVector(random, noise))});
          }
        for (size_t i = 0; i < bricks.size(); i++)
          for (size_t k = 0; k < bricks.size(); k++) {
            if (i == k) continue;
            Transform bInA = inverse(bricks[i]) * bricks[k];
            Vec3 d = bInA.position;
            Manifold m;
            collide(kBrick, kBrick, bInA, 0.01, m);
            bool above = std::fabs(std::fabs(d.y) - 2 * kHalf.y) < 1e-3, level = std::fabs(d.y) < 1e-3;
            double over = 2 * kHalf.x - std::fabs(d.x);  // length of the overlap
            if (above && over > 1e-3) {
              beds++;
              ASSERT_EQ(m.count, 4);
              ASSERT_GT(std::fabs(m.normal.y), 1 - 1e-9);
              for (const ManifoldPoint& p : m.points) ASSERT_LT(std::fabs(p.separation), 1e-5);
            } else if (level && over > -1e-3) {
              heads++;
              ASSERT_EQ(m.count, 4);
              ASSERT_GT(std::fabs(m.normal.x), 1 - 1e-9);
            } else {
              lines += above && over > -1e-3;
              ASSERT_EQ(m.count, 0) << d.x << " " << d.y;
            }
          }
      }
  EXPECT_GT(beds, 1000);
  EXPECT_GT(heads, 800);
  EXPECT_GT(lines, 200);
}

TEST(BoxBox, BricksOfAnySizeStand) {
  for (double scale : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    Shape brick = boxShape(kHalf * scale);
    Transform pose{Vec3{0.1075, 0.0649999, 0.001} * scale, quatFromRotationVector({1e-6, 1e-5, -1e-6})};
    Manifold m;
    collide(brick, brick, pose, 0.01 * scale, m);
    ASSERT_EQ(m.count, 4) << scale;
    EXPECT_GT(m.normal.y, 1 - 1e-9);
    EXPECT_EQ(faultOf(m, brick, brick, pose, 0.01 * scale, 1e-4 * scale), "");
  }
}

TEST(BoxBox, TurnedBrickKeepsFourOfEightCorners) {
  // Squares turned by 45 degrees overlap in a regular octagon.
  Shape tile = boxShape({0.1, 0.03, 0.1});
  Manifold m;
  collide(tile, tile, {{0, 0.06, 0}, quatFromAxisAngle({0, 1, 0}, 0.7853981633974483)}, 0.01, m);
  ASSERT_EQ(m.count, 4);
  double area = 0;
  for (int k = 0; k < 4; k++) area += 0.5 * dot(cross(m.points[k].onA, m.points[(k + 1) % 4].onA), Vec3{0, 1, 0});
  double radius2 = 0.01 / (0.9238795325112867 * 0.9238795325112867);  // of the octagon's corners
  EXPECT_NEAR(std::fabs(area), 2 * radius2, 1e-9);
  // Tilted a little the deepest corner is among them.
  Quat tilt = quatFromRotationVector({0.003, 0, 0.002});
  collide(tile, tile, {{0, 0.06, 0}, tilt * quatFromAxisAngle({0, 1, 0}, 0.7)}, 0.01, m);
  Separation slow = slowSeparation(tile, tile, {{0, 0.06, 0}, tilt * quatFromAxisAngle({0, 1, 0}, 0.7)});
  EXPECT_LT(deepest(m), slow.value + 1e-4);
}

TEST(BoxBox, CrossedEdgesTouchInOnePoint) {
  // A beam on its edge across another on its edge.
  Shape beam = boxShape({0.5, 0.1, 0.1});
  Quat onEdge = quatFromAxisAngle({1, 0, 0}, 0.7853981633974483);
  double r = 0.1 * std::sqrt(2.0);
  Transform lower{{}, onEdge}, upper{{0.2, 2 * r - 0.001, 0.3}, quatFromAxisAngle({0, 1, 0}, 1.3) * onEdge};
  Manifold m;
  collide(beam, beam, inverse(lower) * upper, 0.01, m);
  ASSERT_EQ(m.count, 1);
  Vec3 normal = rotate(lower.rotation, m.normal), onA = transformPoint(lower, m.points[0].onA);
  EXPECT_NEAR(normal.y, 1, 1e-12);
  EXPECT_NEAR(m.points[0].separation, -0.001, 1e-12);
  // The axes cross, seen from above, where the lower one has z = 0.
  double sine, cosine;
  sinCos(1.3, sine, cosine);
  EXPECT_NEAR(onA.z, 0, 1e-12);
  EXPECT_NEAR(onA.x, 0.2 + 0.3 * cosine / sine, 1e-12);
  EXPECT_NEAR(onA.y, r, 1e-12);
}

TEST(BoxBox, CornerOnFaceTouchesInOnePoint) {
  Shape floor = boxShape({1, 0.1, 1}), cube = boxShape({0.1, 0.1, 0.1});
  Quat onCorner = quatFromAxisAngle(normalized(Vec3{1, 0, -1}), 0.9553166181245093);  // a space diagonal upright
  Transform pose{{0.3, 0.1 + 0.1 * std::sqrt(3.0) - 0.002, -0.2}, onCorner};
  Manifold m;
  collide(floor, cube, pose, 0.01, m);
  ASSERT_EQ(m.count, 1);
  EXPECT_EQ(m.normal, (Vec3{0, 1, 0}));
  EXPECT_NEAR(m.points[0].separation, -0.002, 1e-12);
  EXPECT_NEAR(length(m.points[0].onA - Vec3{0.3, 0.1, -0.2}), 0, 1e-12);
}

// Speculative contact: bricks that fly at each other corner first, still far apart against their size, are seen.
TEST(BoxBox, CornerFirstApproachIsSeenFromAfar) {
  Shape cube = boxShape({0.05, 0.05, 0.05});
  Quat onEdge = quatFromAxisAngle({1, 0, 0}, 0.7853981633974483);
  Transform lower{{}, onEdge},
      upper{{0, 0.2 + 0.1 * std::sqrt(2.0), 0}, quatFromAxisAngle({0, 1, 0}, 1.5707963267948966) * onEdge};
  Manifold m;
  collide(cube, cube, inverse(lower) * upper, 0.3, m);
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].separation, 0.2, 1e-12);
  // With a head joint of 5 mm a diagonal neighbour is beyond one face and level with another: no contact either.
  collide(kBrick, kBrick, {{2 * kHalf.x + 0.005, 2 * kHalf.y, 0}, {}}, 0.01, m);
  EXPECT_EQ(m.count, 0);
}

// A resting brick that creeps: contact and names follow without a jump.
TEST(BoxBox, SmallMotionChangesLittle) {
  Random random(31);
  int steps = 0, renamed = 0, jumps = 0;
  for (int trial = 0; trial < 300; trial++) {
    Transform pose{{random.between(-0.15, 0.15), 2 * kHalf.y - 2e-4, random.between(-0.05, 0.05)},
                   quatFromRotationVector(
                       {random.between(-1, 1) * 3e-3, random.between(-1, 1) * 0.1, random.between(-1, 1) * 3e-3})};
    Vec3 drift = randomVector(random, 1e-6), spin = randomVector(random, 1e-5);
    Manifold before;
    collide(kBrick, kBrick, pose, 0.01, before);
    for (int step = 0; step < 100; step++) {
      pose.position += drift;
      pose.rotation = normalized(quatFromRotationVector(spin) * pose.rotation);
      Manifold m;
      collide(kBrick, kBrick, pose, 0.01, m);
      ASSERT_GT(m.count, 0);
      steps++;
      std::set<std::uint32_t> a, b;
      for (int k = 0; k < m.count; k++) a.insert(m.points[k].feature);
      for (int k = 0; k < before.count; k++) b.insert(before.points[k].feature);
      renamed += a != b;
      jumps += length(m.normal - before.normal) > 1e-4;
      ASSERT_LT(length(m.normal - before.normal), 0.02);
      ASSERT_LT(std::fabs(deepest(m) - deepest(before)), 3e-5);
      before = m;
    }
  }
  EXPECT_LT(renamed, steps / 100);
  EXPECT_LT(jumps, steps / 500);
}

TEST(BoxBox, SwappedArgumentsGiveTheSameContact) {
  Random random(17);
  int contacts = 0, same = 0;
  for (int i = 0; i < 10000; i++) {
    Shape a = boxShape(randomHalfExtents(random)), b = boxShape(randomHalfExtents(random));
    Transform pose{randomDirection(random) * random.between(0.05, 0.5), randomRotation(random)};
    Manifold m;
    collide(a, b, pose, 0.005, m);
    Manifold back = swapped(a, b, pose, 0.005);
    bool ambiguous = slowSeparation(a, b, pose).value > -1e-3;  // apart, two faces may see different points
    ASSERT_TRUE(ambiguous || (m.count > 0) == (back.count > 0)) << i;
    if (m.count == 0 || back.count == 0) continue;
    contacts++;
    same += m.count == back.count && dot(m.normal, back.normal) > 1 - 1e-9;
    ASSERT_NEAR(deepest(m), deepest(back), 1.1e-3) << i;
  }
  EXPECT_GT(contacts, 3000);
  EXPECT_GT(same, contacts * 98 / 100);  // the rest has two equally good reference faces
}

TEST(BoxBox, WithinTheMarginButNotFurther) {
  Manifold m;
  collide(kBrick, kBrick, {{0.05, 2 * kHalf.y + 0.0099, 0}, {}}, 0.01, m);
  ASSERT_EQ(m.count, 4);
  EXPECT_NEAR(m.points[0].separation, 0.0099, 1e-15);
  collide(kBrick, kBrick, {{0.05, 2 * kHalf.y + 0.0101, 0}, {}}, 0.01, m);
  EXPECT_EQ(m.count, 0);
  collide(kBrick, kBrick, {}, 0, m);  // in the same place: out upwards, where the brick is thinnest
  ASSERT_EQ(m.count, 4);
  EXPECT_NEAR(deepest(m), -2 * kHalf.y, 1e-15);
}

// Nothing of one box lies over the best face of the other but a point 4 mm above it; an edge axis was better, not by its
// bias. Found by the sweep of tests/oracle/collision.
TEST(BoxBox, OverlapIsHiddenByAPointThatIsApart) {
  Shape a = boxShape({0.0613993025, 0.0332179916, 0.328867458}),
        b = boxShape({0.0726923182, 0.294893815, 0.0872547759});
  Transform pose{{-0.1914705485, 0.07125583586, 0.2477366732},
                 normalized(Quat{-0.208662207101, -0.694708882199, 0.543813142516, 0.422027153568})};
  pose.position -= Vec3{-0.9839, 0, 0.1786} * 2e-5;  // from touching, along the axis of least overlap
  Separation slow = slowSeparation(a, b, pose);
  ASSERT_NEAR(slow.value, -2e-5, 1e-6);
  ASSERT_TRUE(slow.edge);
  Manifold m, back = swapped(a, b, pose, 0.01);
  collide(a, b, pose, 0.01, m);
  ASSERT_GT(m.count, 0);
  EXPECT_NEAR(deepest(m), slow.value, 1e-6);
  ASSERT_GT(back.count, 0);
  EXPECT_NEAR(deepest(back), slow.value, 1e-6);
}

}  // namespace
}  // namespace brickfall
