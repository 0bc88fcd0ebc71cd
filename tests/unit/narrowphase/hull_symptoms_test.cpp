// Pairs of hulls whose contact was wrong, one test per symptom. Most were found by the sweep of tests/oracle/collision.
#include <gtest/gtest.h>

#include <algorithm>

#include "contact_checks.h"

namespace brickfall {
namespace {

using namespace test;

Hull hullOf(const std::vector<Vec3>& corners) { return buildHull(corners).value(); }

struct Sides {
  Manifold m, back;  // the second seen from a, too
};
Sides bothWays(const Shape& a, const Shape& b, const Transform& pose, double margin) {
  Sides out;
  collide(a, b, pose, margin, out.m);
  out.back = swapped(a, b, pose, margin);
  return out;
}

// A blade with a tip of two degrees: a corner 3 micrometres beyond each of its sides, which is let through, was up to 0.17 mm
// beyond its tip.
TEST(HullContact, PointsAreBeyondTheTipOfASliver) {
  Hull blade =
      hullOf({{0, 0, 0}, {0.6, 0, 0.0105}, {0.6, 0, -0.0105}, {0, -0.1, 0}, {0.6, -0.1, 0.0105}, {0.6, -0.1, -0.0105}});
  Hull top = hullOf({{0, 0, 0}, {0.1, 0.1, 0.1}, {-0.1, 0.1, 0.1}, {0.1, 0.1, -0.1}, {-0.1, 0.1, -0.1}});
  Shape a = hullShape(blade), b = hullShape(top);
  Random random(3);
  int contacts = 0, atTip = 0;
  for (int i = 0; i < 4000; i++) {
    Transform pose{{random.between(-5e-4, 5e-4), random.between(-1e-4, 2e-3), random.between(-4e-6, 4e-6)},
                   quatFromRotationVector(randomDirection(random) * 0.3)};
    Sides found = bothWays(a, b, pose, 0.003);
    contacts += found.m.count > 0;
    for (const Manifold* m : {&found.m, &found.back})
      for (int k = 0; k < m->count; k++) {
        ASSERT_LT(distanceByGjk(a, m->points[k].onA), 3e-5) << i;
        atTip += length(m->points[k].onA) < 2e-4;
      }
  }
  EXPECT_GT(contacts, 2000);
  EXPECT_GT(atTip, 200);
}

}  // namespace
}  // namespace brickfall
