// Hulls against hulls and boxes: the box's own function as reference for boxes built as hulls, a brute-force
// separating-axis test for random ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "contact_checks.h"
#include "narrowphase/clipping.h"

namespace brickfall {
namespace {

using namespace test;

Hull boxHull(Vec3 h) {
  std::vector<Vec3> corners = cornersOf(boxShape(h), {});
  return buildHull(corners).value();
}

// The overlap along a direction, seen by projecting all corners; negative = overlap.
double separationAlong(const Shape& a, const Shape& b, const Transform& pose, Vec3 n) {
  double high = -1e30, low = 1e30;
  for (Vec3 p : cornersOf(a, {})) high = std::max(high, dot(p, n));
  for (Vec3 p : cornersOf(b, pose)) low = std::min(low, dot(p, n));
  return low - high;
}

TEST(HullHull, BoxesAsHullsTouchLikeBoxes) {
  Random random(5);
  int agreed = 0, contacts = 0;
  for (int i = 0; i < 6000; i++) {
    Vec3 ha = randomHalfExtents(random), hb = randomHalfExtents(random);
    Shape boxA = boxShape(ha), boxB = boxShape(hb);
    Hull hullA = boxHull(ha), hullB = boxHull(hb);
    Transform pose{randomDirection(random) * random.between(0.2, 1) * (length(ha) + length(hb)),
                   randomRotation(random)};
    if (i % 2) {  // lying on a face of a
      pose.rotation = quatFromAxisAngle({0, 1, 0}, random.between(0, 3));
      pose.position = {random.between(-ha.x, ha.x), ha.y + hb.y + random.between(-0.003, 0.003),
                       random.between(-ha.z, ha.z)};
    }
    Manifold expected, asHulls, mixed;
    collide(boxA, boxB, pose, 0.005, expected);
    collide(hullShape(hullA), hullShape(hullB), pose, 0.005, asHulls);
    collide(boxA, hullShape(hullB), pose, 0.005, mixed);
    ASSERT_EQ(asHulls.count, expected.count) << i;
    ASSERT_EQ(mixed.count, expected.count) << i;
    if (expected.count == 0) continue;
    contacts++;
    ASSERT_NEAR(deepest(asHulls), deepest(expected), 3e-5);
    ASSERT_NEAR(deepest(mixed), deepest(expected), 3e-5);
    ASSERT_GT(dot(asHulls.normal, expected.normal), 1 - 1e-9);
    bool same = true;
    for (int k = 0; k < expected.count; k++) {
      double nearest = 1;
      for (int j = 0; j < asHulls.count; j++)
        nearest = std::min(nearest, length(asHulls.points[j].onA - expected.points[k].onA));
      same = same && nearest < 1e-6;
    }
    agreed += same;
  }
  EXPECT_GT(contacts, 3000);
  EXPECT_GT(agreed, contacts * 8 / 10);  // of more than four points another choice may be as good
}

TEST(HullHull, DiagonalNeighboursThatShareALineDoNotTouch) {
  Vec3 h{0.1, 0.03, 0.05};
  Hull hull = boxHull(h);
  for (double dx : {-1e-9, 0.0, 1e-9, 0.004})
    for (double dy : {-1e-9, 0.0, 1e-9}) {
      Transform pose{{2 * h.x + dx, 2 * h.y + dy, 0}, {}};
      Manifold m;
      collide(hullShape(hull), hullShape(hull), pose, 0.01, m);
      EXPECT_EQ(m.count, 0);
      collide(boxShape(h), hullShape(hull), pose, 0.01, m);
      EXPECT_EQ(m.count, 0);
      pose.position.x -= 0.1;
      collide(hullShape(hull), hullShape(hull), pose, 0.01, m);
      EXPECT_EQ(m.count, 4);
    }
}

TEST(HullHull, RandomPairsAgainstBruteForce) {
  Random random(11);
  constexpr double kMargin = 0.004;
  int apart = 0, overlapping = 0, edges = 0, faces = 0, several = 0;
  for (int i = 0; i < 3000; i++) {
    Hull hullA = randomHull(random, 4 + int(random.below(9))), hullB = randomHull(random, 4 + int(random.below(9)));
    Shape a = hullShape(hullA), b = i % 3 ? hullShape(hullB) : boxShape(randomHalfExtents(random));
    Transform pose{{}, randomRotation(random)};
    Vec3 towards = randomDirection(random);
    if (i % 2) {  // a face of b flat on a face of a
      const HullPlane& plane = hullA.planes[random.below(std::uint32_t(hullA.planes.size()))];
      towards = plane.normal;
      Vec3 down = faceNormalsOf(b, pose)[0], axis = cross(down, -towards);
      double angle = std::atan2(length(axis), dot(down, -towards));
      pose.rotation = quatFromAxisAngle(normalized(axis), angle) * pose.rotation;
    }
    pose.position = towards * (random.between(-0.01, 0.006) - separationAlong(a, b, pose, towards));
    Manifold m;
    collide(a, b, pose, kMargin, m);
    ASSERT_EQ(faultOf(m, a, b, pose, kMargin, 3e-4), "") << i;
    Separation slow = slowSeparation(a, b, pose);
    if (slow.value > kMargin + 1e-9) {
      apart++;
      ASSERT_EQ(m.count, 0) << i;
      continue;
    }
    if (slow.value < -1e-4) {
      overlapping++;
      ASSERT_GT(m.count, 0) << i << " " << slow.value;
    }
    if (m.count == 0) continue;
    double seen = separationAlong(a, b, pose, m.normal);
    if (slow.value < 0) {
      ASSERT_GE(seen, slow.value - 1.1e-3) << i;
    } else {
      ASSERT_GE(deepest(m), -1e-9) << i;
    }
    ASSERT_LE(seen, slow.value + 1e-9) << i;
    ASSERT_GE(deepest(m), seen - 1e-9);
    if (slow.value < -1e-4) {
      ASSERT_LE(deepest(m), slow.value + 2e-3) << i;
    }
    (m.count == 1 && m.points[0].feature >> 28 == 3 ? edges : faces)++;
    several += m.count >= 3;
  }
  EXPECT_GT(overlapping, 800);
  EXPECT_GT(apart, 50);
  EXPECT_GT(edges, 10);  // one point alone
  EXPECT_GT(faces, 1000);
  EXPECT_GT(several, 500);
}

TEST(HullHull, RoundHullsOfSixtyFourCorners) {
  Random random(2);
  int contacts = 0;
  for (int i = 0; i < 60; i++) {
    std::vector<Vec3> cloud;
    for (int k = 0; k < 64; k++) cloud.push_back(randomDirection(random) * 0.2);
    Hull hull = buildHull(cloud).value();
    Shape s = hullShape(hull);
    Transform pose{randomDirection(random) * random.between(0.3, 0.4), randomRotation(random)};
    Manifold m;
    collide(s, s, pose, 0.01, m);
    ASSERT_EQ(faultOf(m, s, s, pose, 0.01, 1e-3), "");
    Separation slow = slowSeparation(s, s, pose);
    if (slow.value < -1e-3) {
      ASSERT_GT(m.count, 0);
      EXPECT_NEAR(deepest(m), slow.value, 2e-3 - 0.1 * slow.value);
      contacts++;
    }
  }
  EXPECT_GT(contacts, 30);
}

// A brick cut by a slanting plane: the two pieces lie face on face, and the lower face of the upper one carries it.
TEST(HullHull, PiecesOfABrickLieOnTheirCut) {
  std::vector<Vec3> lower, upper;
  for (double z : {-0.05, 0.05}) {
    lower.insert(lower.end(), {{-0.1, -0.03, z}, {0.1, -0.03, z}, {-0.1, -0.01, z}, {0.1, 0.01, z}});
    upper.insert(upper.end(), {{-0.1, 0.03, z}, {0.1, 0.03, z}, {-0.1, -0.01, z}, {0.1, 0.01, z}});
  }
  Hull a = buildHull(lower).value(), b = buildHull(upper).value();
  Manifold m;
  collide(hullShape(a), hullShape(b), {}, 0.01, m);
  ASSERT_EQ(m.count, 4);
  Vec3 cut = normalized(Vec3{-0.1, 1, 0});
  EXPECT_GT(dot(m.normal, cut), 1 - 1e-12);
  for (const ManifoldPoint& p : m.points) EXPECT_NEAR(p.separation, 0, 1e-12);
}

TEST(HullHull, SwappedArgumentsGiveTheSameContact) {
  Random random(8);
  int contacts = 0, same = 0;
  for (int i = 0; i < 2000; i++) {
    Hull hull = randomHull(random, 10);
    Shape a = hullShape(hull), b = boxShape(randomHalfExtents(random));
    Transform pose{randomDirection(random) * random.between(0.1, 0.4), randomRotation(random)};
    Manifold m;
    collide(a, b, pose, 0.005, m);
    Manifold back = swapped(a, b, pose, 0.005);
    ASSERT_EQ(m.count > 0, back.count > 0);
    if (m.count == 0) continue;
    contacts++;
    same += m.count == back.count && dot(m.normal, back.normal) > 1 - 1e-9;
    ASSERT_NEAR(deepest(m), deepest(back), 1.1e-3);
  }
  EXPECT_GT(contacts, 500);
  EXPECT_EQ(same, contacts);  // box and hull are brought into one order
}

// A body whose state is not a number must not take the step with it: no contact, no crash, for any pair.
TEST(Collide, PoseThatIsNotANumberTouchesNothing) {
  Random random(1);
  Hull hull = randomHull(random, 12);
  const Shape shapes[] = {planeShape(), sphereShape(0.1), capsuleShape(0.1, 0.2), boxShape({0.1, 0.2, 0.3}),
                          hullShape(hull)};
  const double bad = std::nan("");
  for (const Shape& a : shapes)
    for (const Shape& b : shapes)
      for (int which = 0; which < 7; which++) {
        Transform pose;
        double* number[7] = {&pose.position.x, &pose.position.y, &pose.position.z, &pose.rotation.x,
                             &pose.rotation.y, &pose.rotation.z, &pose.rotation.w};
        *number[which] = bad;
        // Position across a plane and rotation of a sphere do not matter to their contact.
        Manifold m;
        collide(a, b, pose, 0.01, m);
        EXPECT_GE(m.count, 0);
        EXPECT_LE(m.count, kMaxManifoldPoints);
        auto solid = [](const Shape& s) { return s.type != ShapeType::plane && s.type != ShapeType::sphere; };
        if (solid(a) && solid(b)) {
          EXPECT_EQ(m.count, 0) << int(a.type) << " " << int(b.type) << " " << which;
        }
      }
}

// Two corners of a contact polygon nearer to each other than `same`, which both carry: the order in which the polygon is read
// decided which stays, and a corner of a small body was lost that lay four times as deep as the other.
TEST(Clipping, OfTwoLoadedCornersThatAreOneTheDeeperStays) {
  const ContactTolerances tolerance = contactTolerances(0.0325);
  const PatchPoint deep{0, 0, -0.9 * tolerance.same, 7}, shallow{0, 0, -0.1 * tolerance.same, 8};
  LoadedPoints both, one;
  both.add(7), both.add(8), one.add(8);
  for (const bool deepFirst : {false, true}) {
    PatchPoint points[kMaxPatchPoints] = {deepFirst ? deep : shallow, deepFirst ? shallow : deep};
    ASSERT_EQ(reducePatch(points, 2, tolerance, both).count, 1);
    EXPECT_EQ(points[0].feature, 7u);
    PatchPoint again[kMaxPatchPoints] = {deepFirst ? deep : shallow, deepFirst ? shallow : deep};
    ASSERT_EQ(reducePatch(again, 2, tolerance, one).count, 1);
    EXPECT_EQ(again[0].feature, 8u) << "of a body that stands the point that carries stays";
  }
}

}  // namespace
}  // namespace brickfall
