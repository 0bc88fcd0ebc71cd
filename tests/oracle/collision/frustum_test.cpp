// Cylinders and cones near touching against a slow method: the direction of least overlap by walking over the sphere of
// directions in extended precision, from many starts. It shares nothing with the engine but the definition of the solids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/queries.h"
#include "narrowphase/clipping.h"
#include "narrowphase/collide.h"
#include "solid.h"
#include "support/random_geometry.h"

namespace brickfall::oracle {
namespace {

bool isTurned(const Shape& s) { return s.type == ShapeType::cylinder || s.type == ShapeType::cone; }

Real supportOf(const Shape& s, Vector d) {
  const Real across = std::sqrt(d.x * d.x + d.z * d.z), half = s.halfHeight, low = s.radius,
             high = s.type == ShapeType::cone ? s.topRadius : s.radius;
  if (isTurned(s)) return std::max(across * low - d.y * half, across * high + d.y * half);
  if (s.type == ShapeType::capsule) return std::fabs(d.y) * half + low;
  const Vector h = wide(s.halfExtents);
  return std::fabs(d.x) * h.x + std::fabs(d.y) * h.y + std::fabs(d.z) * h.z;
}

struct Directions {
  const Shape &a, &b;
  Mat3T<Real> turn;
  Vector position;

  Real gap(Vector n) const {
    const Vector back{dot(turn.column(0), -n), dot(turn.column(1), -n), dot(turn.column(2), -n)};
    return dot(n, position) - supportOf(b, back) - supportOf(a, n);
  }
  // Uphill from `n` by ever smaller steps across, in twelve directions.
  Real climb(Vector n) const {
    constexpr Real kCosine[12] = {1,  0.8660254037844386468L,  0.5L,  0, -0.5L, -0.8660254037844386468L,
                                  -1, -0.8660254037844386468L, -0.5L, 0, 0.5L,  0.8660254037844386468L};
    Real best = gap(n);
    int looks = 0;
    for (Real step = 0.2L; step > 1e-6L && looks < 300; looks++) {
      const Vector side = normalized(cross(n, std::fabs(n.x) < 0.7L ? Vector{1, 0, 0} : Vector{0, 1, 0})),
                   other = cross(n, side);
      Vector next = n;
      const Real before = best;
      for (int k = 0; k < 12; k++) {
        const Vector tried = normalized(n + side * (step * kCosine[k]) + other * (step * kCosine[(k + 9) % 12]));
        if (Real found = gap(tried); found > best) best = found, next = tried;
      }
      n = next;
      if (!(best > before + 1e-3L * step)) step *= 0.5L;
    }
    return best;
  }
};

Shape drawShape(Random& random, int kind) {
  Shape s;
  s.type = kind == 0   ? ShapeType::box
           : kind == 1 ? ShapeType::capsule
           : kind == 2 ? ShapeType::cylinder
                       : ShapeType::cone;
  s.halfExtents = {random.between(0.05, 0.4), random.between(0.05, 0.4), random.between(0.05, 0.4)};
  s.radius = random.between(0.05, 0.4), s.halfHeight = random.between(0.05, 0.4);
  if (kind == 3 && random.below(2)) s.topRadius = random.between(0.02, 0.4);
  return s;
}

TEST(Frustums, NearTouchingAgainstTheSlowMethod) {
  Random random(11);
  int checked = 0, points[5] = {};
  for (int round = 0; round < 240; round++) {
    const Shape a = drawShape(random, round % 4), b = drawShape(random, 2 + round / 4 % 2);
    Transform pose{test::randomDirection(random) * 2.0, test::randomRotation(random)};
    if (round % 5 == 0) pose.rotation = {};
    const DistanceResult apart = shapeDistance(a, b, pose);
    const Vec3 n = normalized(apart.onB - apart.onA);
    const double overlap = round % 3 == 0 ? -1e-3 : round % 3 == 1 ? 1e-6 : 1e-3;
    pose.position -= n * (apart.distance + overlap);
    const QuatT<Real> q = normalized(QuatT<Real>{pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w});
    const Directions slow{a, b, toMatrix(q), wide(pose.position)};
    Real best = slow.climb(wide(n));
    for (int start = 0; start < 4; start++) {
      best = std::max(best, slow.climb(wide(normalized(n + test::randomDirection(random) * 0.5))));
    }
    Manifold m;
    collide(a, b, pose, 0.01, m);
    SCOPED_TRACE("round " + std::to_string(round));
    ASSERT_GT(m.count, 0);
    double deepest = 1;
    for (int k = 0; k < m.count; k++) deepest = std::min(deepest, m.points[k].separation);
    const double allowed = contactTolerances(std::min(innerRadius(a), innerRadius(b))).edge + 1e-6;  // as of hulls
    EXPECT_NEAR(deepest, double(best), allowed);
    checked++, points[m.count]++;
  }
  EXPECT_EQ(checked, 240);
  EXPECT_GT(points[1], 100);
  EXPECT_GT(points[2] + points[3] + points[4], 4);
}

}  // namespace
}  // namespace brickfall::oracle
