// Boxes against references: random pairs by regime against a brute-force separating-axis test and against FCL, and the
// shared vectors of two boxes with independently computed answers.
#include <gtest/gtest.h>

#include <algorithm>

#include "contact_checks.h"
#include "fcl_oracle.h"
#include "support/obb_vectors.h"

namespace brickfall {
namespace {

using namespace test;

enum class Regime { generic, nearParallel, faceOnFace, edgeOnEdge, cornerOnFace, deep, touching };
constexpr int kRegimes = 7;

struct Pair {
  Shape a, b;
  Transform pose;  // of b in a
};

// Moves b along `axis` until the two overlap by `depth` along it.
void setDepth(Pair& pair, Vec3 axis, double depth) {
  double high = -1e30, low = 1e30;
  for (Vec3 p : cornersOf(pair.a, {})) high = std::max(high, dot(p, axis));
  for (Vec3 p : cornersOf(pair.b, pair.pose)) low = std::min(low, dot(p, axis));
  pair.pose.position += axis * (high - low - depth);
}

Quat tiny(Random& random, double angle) { return quatFromRotationVector(randomDirection(random) * angle); }

Pair randomPair(Random& random, Regime regime) {
  Pair pair{boxShape(randomHalfExtents(random)), boxShape(randomHalfExtents(random)), {}};
  Vec3 ha = pair.a.halfExtents, hb = pair.b.halfExtents;
  int axis = int(random.below(3));
  Vec3 up;
  up[axis] = random.unit() < 0.5 ? -1 : 1;
  // A place beside: within the face that b lies on.
  Vec3 shift = scaled(ha, Vec3{random.between(-0.9, 0.9), random.between(-0.9, 0.9), random.between(-0.9, 0.9)});
  shift[axis] = 0;
  pair.pose.position = shift;
  switch (regime) {
    case Regime::generic:
      pair.pose.rotation = randomRotation(random);
      pair.pose.position = randomDirection(random) * random.between(0.0, 1.1 * (length(ha) + length(hb)));
      break;
    case Regime::nearParallel:
      pair.pose.rotation = tiny(random, std::pow(10.0, random.between(-9, -2)));
      setDepth(pair, up, random.between(-0.004, 0.01));
      break;
    case Regime::faceOnFace:
      pair.pose.rotation = quatFromAxisAngle(up, random.between(-3.1, 3.1));
      setDepth(pair, up, random.between(-0.004, 0.004));
      break;
    case Regime::edgeOnEdge: {
      // An edge of a along axis 0 and one of b, crossing at their middles at a large angle, shapes pointing at each
      // other.
      pair.pose.rotation =
          quatFromAxisAngle({0, 1, 0}, random.between(0.5, 2.6)) * quatFromAxisAngle({1, 0, 0}, 0.7853981634);
      Vec3 outA = normalized(Vec3{0, 1, 0});
      pair.pose.rotation = quatFromAxisAngle({1, 0, 0}, 0.7853981634) * pair.pose.rotation;
      outA = normalized(rotate(quatFromAxisAngle({1, 0, 0}, 0.7853981634), Vec3{0, 1, 0}));
      Vec3 edgeA{random.between(-0.5, 0.5) * ha.x, ha.y, ha.z};
      Vec3 lowest;
      double low = 1e30;
      for (double s : {-1.0, 1.0})
        for (double t : {-1.0, 1.0}) {
          Vec3 p = rotate(pair.pose.rotation, {random.between(-0.5, 0.5) * hb.x, s * hb.y, t * hb.z});
          if (dot(p, outA) < low) low = dot(p, outA), lowest = p;
        }
      pair.pose.position = edgeA - lowest + outA * random.between(-0.006, 0.003);
      break;
    }
    case Regime::cornerOnFace:
      pair.pose.rotation = quatFromAxisAngle(randomDirection(random), random.between(0.5, 2.5));
      setDepth(pair, up, random.between(-0.004, 0.01));
      break;
    case Regime::deep:
      pair.pose.rotation = randomRotation(random);
      pair.pose.position = randomDirection(random) * random.between(0, 0.3) * std::min(ha.x, hb.x);
      break;
    case Regime::touching:
      pair.pose.rotation = random.unit() < 0.5 ? quatFromAxisAngle(up, 1.5707963267948966 * random.below(4)) : Quat{};
      setDepth(pair, up, random.between(-1e-9, 1e-9));
      break;
  }
  return pair;
}

TEST(BoxOracle, RandomPairsOfEveryRegime) {
  Random random(20);
  constexpr double kMargin = 0.005;
  int contacts[kRegimes] = {}, apart[kRegimes] = {}, edges[kRegimes] = {}, full[kRegimes] = {}, fclAsked = 0,
      within = 0;
  for (int i = 0; i < 42000; i++) {
    Regime regime = Regime(i % kRegimes);
    int r = int(regime);
    Pair pair = randomPair(random, regime);
    SCOPED_TRACE("pair " + std::to_string(i) + " regime " + std::to_string(r));
    Manifold m;
    collide(pair.a, pair.b, pair.pose, kMargin, m);
    ASSERT_EQ(faultOf(m, pair.a, pair.b, pair.pose, kMargin, 3e-4), "");
    Separation slow = slowSeparation(pair.a, pair.b, pair.pose);
    if (slow.value > kMargin + 1e-9) {
      apart[r]++;
      ASSERT_EQ(m.count, 0) << slow.value;
      continue;
    }
    if (slow.value > -1e-4) {
      within += m.count > 0;
      if (regime == Regime::faceOnFace || regime == Regime::touching) {
        ASSERT_GE(m.count, 3);
      }
    } else {
      contacts[r]++;
      ASSERT_GT(m.count, 0) << slow.value;
    }
    if (m.count == 0) continue;
    edges[r] += m.points[0].feature >> 28 == 3 && m.count == 1;
    full[r] += m.count == 4;
    // The depth that the manifold shows: the least there is, up to the bias for faces.
    Vec3 n = m.normal;
    double high = -1e30, low = 1e30;
    for (Vec3 p : cornersOf(pair.a, {})) high = std::max(high, dot(p, n));
    for (Vec3 p : cornersOf(pair.b, pair.pose)) low = std::min(low, dot(p, n));
    if (slow.value < 0) {
      const Vec3 thin = min(pair.a.halfExtents, pair.b.halfExtents);
      ASSERT_GE(low - high, slow.value - 0.034 * std::min({thin.x, thin.y, thin.z}))
          << "not nearly the axis of least overlap";
    } else {
      ASSERT_GE(deepest(m), -1e-9) << "apart, yet overlapping points";
    }
    ASSERT_LE(low - high, slow.value + 1e-9);
    ASSERT_GE(deepest(m), low - high - 1e-9);
    if (slow.value < -1e-4) {
      ASSERT_LE(deepest(m), slow.value + 2e-3);
    }
    if (i % 5 == 0 && std::fabs(slow.value) > 1e-6) {
      fclAsked++;
      ASSERT_EQ(fclBoxesOverlap(pair.a.halfExtents, pair.b.halfExtents, pair.pose), slow.value < 0);
    }
  }
  for (int r = 0; r < kRegimes; r++) {
    SCOPED_TRACE("regime " + std::to_string(r));
    bool touching = Regime(r) == Regime::touching;
    EXPECT_GT(contacts[r], touching ? -1 : 1000);
    EXPECT_GT(apart[r] + contacts[r], touching ? -1 : 2000);
  }
  EXPECT_GT(edges[int(Regime::edgeOnEdge)], 1000);
  EXPECT_GT(edges[int(Regime::generic)], 100);
  EXPECT_GT(full[int(Regime::faceOnFace)], 3000);
  EXPECT_GT(full[int(Regime::touching)], 3000);
  EXPECT_GT(fclAsked, 3000);
  EXPECT_GT(within, 5000);
}

TEST(BoxOracle, SharedVectors) {
  int overlapping = 0, apart = 0, normals = 0;
  for (const test::ObbVector& v : test::obbVectors()) {
    SCOPED_TRACE("case " + std::to_string(v.id) + " " + v.category);
    Shape a = boxShape(v.halfA), b = boxShape(v.halfB);
    Transform bInA = inverse(v.poseA) * v.poseB;
    Manifold m;
    collide(a, b, bInA, 0, m);
    if (!v.overlap) {
      apart++;
      EXPECT_TRUE(m.count == 0 || v.distance.value_or(0) <= v.tolerance);
      continue;
    }
    double smallest = std::min({v.halfA.x, v.halfA.y, v.halfA.z, v.halfB.x, v.halfB.y, v.halfB.z});
    double bias = 0.034 * smallest;
    double depth = v.penetration.value_or(0);
    if (v.touching || depth < bias) continue;
    overlapping++;
    ASSERT_GT(m.count, 0);
    EXPECT_EQ(faultOf(m, a, b, bInA, 0, std::max(3e-4 * v.size, v.tolerance)), "");
    EXPECT_NEAR(-deepest(m), depth, bias + v.tolerance);
    if (!v.penetrationNormal) continue;
    Vec3 normal = rotate(conjugate(v.poseA.rotation), *v.penetrationNormal);
    normals += dot(normal, m.normal) > 1 - 1e-6;  // elsewhere a face within the bias was taken, or axes tie
  }
  EXPECT_GT(overlapping, 20);
  EXPECT_GT(apart, 60);
  EXPECT_GT(normals, 15);
}

}  // namespace
}  // namespace brickfall
