// The separating axis test in the plane against clipping one polygon by the other.
#include "brickfall/geometry/polygon2d.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "math/random.h"

namespace brickfall {
namespace {

using Polygon = std::vector<Vec2>;

Polygon randomPolygon(Random& random, Vec2 centre, double size) {
  int count = 3 + int(random.below(6));
  std::vector<double> angles;
  for (int k = 0; k < count; k++) angles.push_back(2 * M_PI * (k + random.between(0, 0.8)) / count);
  Polygon out;
  for (double angle : angles) out.push_back(centre + Vec2{std::cos(angle), std::sin(angle)} * size);
  return out;  // on a circle, so convex
}

// What is left of a inside b; empty if they are apart.
Polygon clipped(Polygon a, const Polygon& b) {
  for (std::size_t k = 0; k < b.size() && !a.empty(); k++) {
    Vec2 p = b[k], along = b[(k + 1) % b.size()] - p;
    Polygon next;
    for (std::size_t m = 0; m < a.size(); m++) {
      Vec2 q = a[m], r = a[(m + 1) % a.size()];
      double sq = cross(along, q - p), sr = cross(along, r - p);
      if (sq >= 0) next.push_back(q);
      if ((sq > 0 && sr < 0) || (sq < 0 && sr > 0)) next.push_back(q + (r - q) * (sq / (sq - sr)));
    }
    a = next;
  }
  return a;
}

TEST(Plane, AgainstClipping) {
  Random random(21);
  int apart = 0, overlapping = 0, early = 0;
  for (int k = 0; k < 20000; k++) {
    Polygon a = randomPolygon(random, {random.between(-1, 1), random.between(-1, 1)}, random.between(0.1, 1.2));
    Polygon b = randomPolygon(random, {random.between(-1, 1), random.between(-1, 1)}, random.between(0.1, 1.2));
    auto result = separatingAxis<double>(std::span<const Vec2>(a), std::span<const Vec2>(b));
    ASSERT_TRUE(result) << result.error().message;
    bool overlap = !clipped(a, b).empty();
    EXPECT_EQ(result->axis < 0, overlap) << "pair " << k << " gap " << result->gap;
    if (result->axis >= 0) {
      apart++;
      early += result->tested < int(a.size() + b.size());
      EXPECT_EQ(result->tested, result->axis + 1);
      EXPECT_GT(result->gap, 0);
    } else {
      overlapping++;
      EXPECT_EQ(result->tested, int(a.size() + b.size()));
    }
  }
  EXPECT_GE(apart, 3000);
  EXPECT_GE(overlapping, 3000);
  EXPECT_GE(early, apart / 2);
}

TEST(Plane, RectanglesAsPolygons) {
  Random random(22);
  int apart = 0;
  auto make = [&] {
    double angle = random.between(0, 6.3);
    return Rectangle{{random.between(-1.5, 1.5), random.between(-1.5, 1.5)},
                     {std::cos(angle), std::sin(angle)},
                     {random.between(0.1, 1), random.between(0.1, 1)}};
  };
  for (int k = 0; k < 20000; k++) {
    Rectangle a = make(), b = make();
    Polygon pa = corners(a), pb = corners(b);
    auto direct = separatingAxis(a, b);
    auto polygons = separatingAxis<double>(std::span<const Vec2>(pa), std::span<const Vec2>(pb));
    ASSERT_TRUE(direct && polygons);
    EXPECT_EQ(direct->axis < 0, polygons->axis < 0) << "pair " << k << " gap " << direct->gap << " " << polygons->gap;
    if (direct->axis < 0) continue;
    apart++;
    // Axis 0 of a rectangle is that of its edges 1 and 3, axis 1 that of 0 and 2.
    int edge = polygons->axis % 4, first = polygons->axis / 4 * 2;
    EXPECT_TRUE(direct->axis == first + (edge % 2 ? 0 : 1) || direct->axis / 2 == first / 2);
  }
  EXPECT_GE(apart, 4000);
}

TEST(Plane, MovingPolygonsTouchWhenTheyMeet) {
  Random random(23);
  int hits = 0, misses = 0, started = 0;
  for (int k = 0; k < 5000; k++) {
    Polygon a = randomPolygon(random, {0, 0}, random.between(0.2, 1));
    Vec2 from{random.between(-3, 3), random.between(-3, 3)};
    Polygon b = randomPolygon(random, from, random.between(0.2, 1));
    Vec2 velocity = Vec2{random.between(-1, 1), random.between(-1, 1)} - from;
    auto result = firstContact<double>(a, b, velocity, 1.5);
    ASSERT_TRUE(result) << result.error().message;
    auto overlapAt = [&](double t) {
      Polygon moved = b;
      for (Vec2& p : moved) p = p + velocity * t;
      return separatingAxis<double>(std::span<const Vec2>(a), std::span<const Vec2>(moved))->axis < 0;
    };
    if (!result->hit) {
      misses++;
      for (int s = 0; s <= 60; s++) EXPECT_FALSE(overlapAt(1.5 * s / 60)) << "pair " << k;
    } else if (result->axis < 0) {
      started++;
      EXPECT_TRUE(overlapAt(0));
    } else {
      hits++;
      EXPECT_FALSE(overlapAt(result->time - 1e-9));
      EXPECT_LT(dot(result->normal, velocity), 0);
      // Pushed in a little along the normal they overlap.
      Polygon moved = b;
      for (Vec2& p : moved) p = p + velocity * result->time - result->normal * 1e-9;
      EXPECT_TRUE(separatingAxis<double>(std::span<const Vec2>(a), std::span<const Vec2>(moved))->axis < 0)
          << "pair " << k;
    }
  }
  EXPECT_GE(hits, 1000);
  EXPECT_GE(misses, 100);
  EXPECT_GE(started, 50);
}

TEST(Plane, TouchingSquares) {
  Rectangle a, b;
  b.centre = {1, 0};
  EXPECT_EQ(separatingAxis(a, b)->axis, -1);
  b.centre = {1.25, 0};
  EXPECT_EQ(separatingAxis(a, b)->axis, 0);
  EXPECT_EQ(separatingAxis(a, b)->gap, 0.25);
  b.centre = {0, -1.5};
  EXPECT_EQ(separatingAxis(a, b)->axis, 1);
  EXPECT_EQ(separatingAxis(a, b)->direction, (Vec2{0, -1}));
  Polygon pa = corners(a), pb = corners(b);
  auto impact = firstContact<double>(pa, pb, {0, 1}, 10);
  ASSERT_TRUE(impact);
  EXPECT_TRUE(impact->hit);
  EXPECT_EQ(impact->time, 0.5);
  EXPECT_EQ(impact->normal, (Vec2{0, -1}));
  EXPECT_FALSE(firstContact<double>(pa, pb, {0, 1}, 0.4)->hit);
}

TEST(Plane, BadPolygonsAreErrorValues) {
  const double nan = std::nan("");
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_TRUE(checkPolygon<double>(square));
  EXPECT_TRUE(checkPolygon<double>(Polygon{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}));  // a corner within an edge
  for (const Polygon& bad :
       {Polygon{}, Polygon{{0, 0}, {1, 0}}, Polygon{{0, 0}, {0, 1}, {1, 1}, {1, 0}}, Polygon{{0, 0}, {1, 0}, {nan, 1}},
        Polygon{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, Polygon{{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}},
        Polygon{{0, 0}, {1, 0}, {2, 0}}, Polygon{{0, 1}, {-0.6, -0.8}, {0.95, 0.3}, {-0.95, 0.3}, {0.6, -0.8}}}) {
    EXPECT_FALSE(checkPolygon<double>(bad));
    EXPECT_FALSE(separatingAxis<double>(std::span<const Vec2>(square), std::span<const Vec2>(bad)));
    EXPECT_FALSE(firstContact<double>(bad, square, {1, 0}, 1));
  }
  Rectangle good, bad;
  bad.halfExtents.x = -1;
  EXPECT_FALSE(separatingAxis(good, bad));
  bad = {};
  bad.axis = {2, 0};
  EXPECT_FALSE(separatingAxis(good, bad));
  bad = {};
  bad.centre.y = nan;
  EXPECT_FALSE(separatingAxis(bad, good));
  EXPECT_FALSE(firstContact<double>(square, square, {nan, 0}, 1));
  EXPECT_FALSE(firstContact<double>(square, square, {1, 0}, nan));
}

}  // namespace
}  // namespace brickfall
