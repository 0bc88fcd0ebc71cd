// Fits contain what they are fitted to, come out right where the answer is known, and take degenerate points.
#include "brickfall/geometry/fitting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "brickfall/geometry/shape_mesh.h"
#include "obb_cases.h"
#include "support/random_geometry.h"

namespace brickfall {
namespace {

using test::as;
using test::exactly;

constexpr ObbFit kFits[] = {ObbFit::pointCovariance, ObbFit::surfaceCovariance, ObbFit::hullCovariance,
                            ObbFit::smallest};

double volume(const Obb& b) { return 8 * b.halfExtents.x * b.halfExtents.y * b.halfExtents.z; }

template <class T> std::vector<Vec3T<T>> asPoints(const std::vector<Vec3>& points) {
  std::vector<Vec3T<T>> out;
  for (Vec3 p : points) out.push_back(as<T>(p));
  return out;
}

template <class T> void expectHolds(const ObbT<T>& box, const std::vector<Vec3T<T>>& points, double scale) {
  ASSERT_TRUE(checkObb(box)) << checkObb(box).error().message;
  Obb exact{exactly(box.centre),
            {{exactly(box.axes.row[0]), exactly(box.axes.row[1]), exactly(box.axes.row[2])}},
            exactly(box.halfExtents)};
  for (const Vec3T<T>& p : points) {
    Vec3 local = abs(toLocal(exact, exactly(p)));
    for (int k = 0; k < 3; k++) EXPECT_LE(local[k], exact.halfExtents[k] + 1e-14 * scale);
  }
}

std::vector<Vec3> cloud(Random& random, int count, Vec3 half, const Transform& pose) {
  std::vector<Vec3> out;
  for (int k = 0; k < count; k++) out.push_back(transformPoint(pose, scaled(test::randomVector(random, 1), half)));
  return out;
}

template <class T> class Fitting : public testing::Test {};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(Fitting, Precisions);

TYPED_TEST(Fitting, EveryMethodHoldsThePoints) {
  using T = TypeParam;
  Random random(1);
  for (int k = 0; k < 60; k++) {
    Transform pose = test::randomPose(random, 10);
    std::vector<Vec3T<T>> points = asPoints<T>(cloud(random, 1 + int(random.below(60)), {2, 1, 0.5}, pose));
    for (ObbFit fit : kFits) {
      auto box = fitObb<T>(points, fit);
      ASSERT_TRUE(box);
      expectHolds(*box, points, 20);
    }
    auto sphere = fitSphere<T>(points);
    ASSERT_TRUE(sphere);
    for (const auto& p : points) {
      EXPECT_LE(length(exactly(p) - exactly(sphere->centre)), double(sphere->radius) * (1 + 1e-15));
    }
    auto aabb = fitAabb<T>(points);
    ASSERT_TRUE(aabb);
    Vec3 low = exactly(points[0]), high = low;
    for (const auto& p : points) low = min(low, exactly(p)), high = max(high, exactly(p));
    EXPECT_EQ(aabb->lower, low);
    EXPECT_EQ(aabb->upper, high);
  }
}

// The corners of a box: the covariance of its hull's surface has the box's axes, so the fit is the box.
TEST(FittingObb, FindsABox) {
  Random random(2);
  for (int k = 0; k < 100; k++) {
    Obb box = makeObb(test::randomPose(random, 5), Vec3{0.3, 0.7 + 0.1 * random.unit(), 1.6});
    auto c = corners(box);
    for (ObbFit fit : {ObbFit::hullCovariance, ObbFit::smallest, ObbFit::pointCovariance}) {
      auto found = fitObb<double>(c, fit);
      ASSERT_TRUE(found);
      EXPECT_NEAR(volume(*found), volume(box), 1e-6 * volume(box));
      EXPECT_LT(length(found->centre - box.centre), 1e-6);
    }
  }
}

// A cube has no principal axes; only turning finds it.
TEST(FittingObb, SmallestFindsACube) {
  Random random(3);
  for (int k = 0; k < 50; k++) {
    Obb cube = makeObb(test::randomPose(random, 5), Vec3{0.5, 0.5, 0.5});
    auto c = corners(cube);
    auto found = fitObb<double>(c, ObbFit::smallest);
    ASSERT_TRUE(found);
    EXPECT_NEAR(volume(*found), 1, 1e-6);
  }
}

// Gottschalk's case: a box's corners and a dense heap of points in one corner of it, which draws the covariance of the
// points but not that of the hull.
TEST(FittingObb, TheHullsCovarianceDoesNotSeeDensity) {
  Random random(4);
  double byPoints = 0, byHull = 0;
  for (int k = 0; k < 20; k++) {
    Obb box = makeObb(test::randomPose(random, 5), Vec3{0.4, 0.8, 1.6});
    std::vector<Vec3> points;
    for (Vec3 c : corners(box)) points.push_back(c);
    for (int n = 0; n < 500; n++) points.push_back(toWorld(box, Vec3{0.3, 0.7, 1.5} + test::randomVector(random, 0.1)));
    auto bad = fitObb<double>(points, ObbFit::pointCovariance), good = fitObb<double>(points, ObbFit::hullCovariance);
    ASSERT_TRUE(bad && good);
    byPoints += volume(*bad) / volume(box) / 20, byHull += volume(*good) / volume(box) / 20;
  }
  std::printf("  volume over that of the box: points' covariance %.3f, hull's %.6f\n", byPoints, byHull);
  EXPECT_GT(byPoints, 1.2);
  EXPECT_NEAR(byHull, 1, 1e-5);
}

TEST(FittingObb, SmallestIsNeverLarger) {
  Random random(5);
  double ratio[3] = {0, 0, 0};
  const int rounds = 60;
  for (int k = 0; k < rounds; k++) {
    std::vector<Vec3> points = test::randomPoints(random, 5 + int(random.below(60)), {1, 2, 0.7}, k % 2);
    Transform pose = test::randomPose(random, 4);
    for (Vec3& p : points) p = transformPoint(pose, p);
    auto smallest = fitObb<double>(points, ObbFit::smallest);
    ASSERT_TRUE(smallest);
    for (int f = 0; f < 3; f++) {
      auto other = fitObb<double>(points, kFits[f]);
      ASSERT_TRUE(other);
      EXPECT_LE(volume(*smallest), volume(*other) * (1 + 1e-9));
      ratio[f] += volume(*other) / volume(*smallest) / rounds;
    }
    // No small turn makes it smaller by more than what a local minimum allows for; many random ones are tried.
    for (int n = 0; n < 30; n++) {
      Obb axes = makeObb({{}, test::randomRotation(random)}, Vec3{1, 1, 1});
      Vec3 low = axes.axes * points[0], high = low;
      for (Vec3 p : points) low = min(low, axes.axes * p), high = max(high, axes.axes * p);
      Vec3 side = high - low;
      EXPECT_GE(side.x * side.y * side.z, volume(*smallest) * 0.999) << "round " << k;
    }
  }
  std::printf("  volume over the smallest: points' covariance %.3f, hull's %.3f\n", ratio[0], ratio[2]);
}

TEST(FittingObb, MeshesUseTheirTriangles) {
  ShapeMesh mesh = boxMesh({0.4, 0.8, 1.6});
  Transform pose{{1, 2, 3}, normalized(Quat{0.3, 0.2, -0.5, 1})};
  std::vector<Vec3> points;
  for (const auto& p : mesh.positions) points.push_back(transformPoint(pose, {p[0], p[1], p[2]}));
  points.push_back({100, 100, 100});  // no triangle uses it
  for (ObbFit fit : kFits) {
    auto box = fitObb<double>(points, mesh.indices, fit);
    ASSERT_TRUE(box);
    EXPECT_NEAR(volume(*box), 8 * 0.4 * 0.8 * 1.6, 1e-5);
  }
  std::vector<std::uint32_t> bad = {0, 1, 99};
  EXPECT_FALSE(fitObb<double>(points, bad));
  bad = {0, 1};
  EXPECT_FALSE(fitObb<double>(points, bad));
}

TYPED_TEST(Fitting, DegeneratePoints) {
  using T = TypeParam;
  Random random(6);
  for (int k = 0; k < 40; k++) {
    Transform pose = test::randomPose(random, 3);
    struct Sort {
      Vec3 half;
      int flat;  // sides without length
    };
    for (Sort sort : {Sort{{0, 0, 0}, 3}, Sort{{1, 0, 0}, 2}, Sort{{1, 0.5, 0}, 1}}) {
      for (int count : {1, 2, 3, 5, 40}) {
        std::vector<Vec3> exact = cloud(random, count, sort.half, pose);
        exact.push_back(exact[0]);  // twice
        std::vector<Vec3T<T>> points = asPoints<T>(exact);
        for (ObbFit fit : kFits) {
          auto box = fitObb<T>(points, fit);
          ASSERT_TRUE(box);
          expectHolds(*box, points, 10);
          int flat = 0;
          for (int i = 0; i < 3; i++) flat += double(box->halfExtents[i]) < (sizeof(T) == 4 ? 5e-6 : 1e-8);
          EXPECT_GE(flat, sort.flat) << "count " << count << " method " << int(fit);
        }
        ASSERT_TRUE(fitSphere<T>(points));
      }
    }
  }
  std::vector<Vec3T<T>> none;
  EXPECT_FALSE(fitObb<T>(none));
  EXPECT_FALSE(fitAabb<T>(none));
  EXPECT_FALSE(fitSphere<T>(none));
  for (T value : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
    std::vector<Vec3T<T>> bad = {{0, 0, 0}, {1, value, 0}, {0, 1, 0}};
    EXPECT_FALSE(fitObb<T>(bad));
    EXPECT_FALSE(fitAabb<T>(bad));
    EXPECT_FALSE(fitSphere<T>(bad));
  }
}

// Of all balls through two, three or four of the points that hold them all, the smallest: by brute force.
TEST(FittingSphere, IsTheSmallest) {
  Random random(7);
  for (int k = 0; k < 100; k++) {
    std::vector<Vec3> points = k % 3 == 0 ? cloud(random, 12, {1, 1, 0}, test::randomPose(random, 2))
                                          : test::randomPoints(random, 12, {1, 2, 0.5}, k % 3 == 1);
    auto sphere = fitSphere<double>(points);
    ASSERT_TRUE(sphere);
    // No centre nearby does better: the largest distance is a convex function, so a local minimum is the minimum.
    for (double step : {1e-1, 1e-3, 1e-5}) {
      for (int n = 0; n < 100; n++) {
        Vec3 centre = sphere->centre + test::randomDirection(random) * step;
        double most = 0;
        for (Vec3 p : points) most = std::max(most, length(p - centre));
        EXPECT_GT(most, sphere->radius * (1 - 1e-13)) << "round " << k << " step " << step;
      }
    }
  }
  auto ball = fitSphere<double>(corners(Obb{{1, 2, 3}, {}, {1, 1, 1}}));
  ASSERT_TRUE(ball);
  EXPECT_NEAR(ball->radius, std::sqrt(3.0), 1e-12);
  EXPECT_LT(length(ball->centre - Vec3{1, 2, 3}), 1e-12);
  Random many(8);
  std::vector<Vec3> points = test::randomPoints(many, 20000, {1, 1, 1}, true);
  auto unit = fitSphere<double>(points);
  ASSERT_TRUE(unit);
  EXPECT_NEAR(unit->radius, 1, 1e-3);
  EXPECT_LE(unit->radius, 1 + 1e-12);
}

TEST(FittingObb, ManyPoints) {
  Random random(9);
  std::vector<Vec3> points = test::randomPoints(random, 20000, {1, 2, 3}, true);
  for (ObbFit fit : {ObbFit::hullCovariance, ObbFit::pointCovariance}) {
    auto box = fitObb<double>(points, fit);
    ASSERT_TRUE(box);
    EXPECT_NEAR(volume(*box), 48, 0.5);
    expectHolds(*box, points, 10);
  }
}

}  // namespace
}  // namespace brickfall
