#include "viewer_window/outline.h"

#include <gtest/gtest.h>

namespace brickfall::viewer {
namespace {

double lengthOf(const std::vector<std::pair<Vec3, Vec3>>& edges) {
  double sum = 0;
  for (const auto& [from, to] : edges) sum += length(to - from);
  return sum;
}

TEST(Outline, ofAHullHasNoLinesAcrossItsFaces) {
  ShapeDef hull;
  hull.type = ShapeType::hull;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) hull.vertices.push_back({x, y, z});
  const auto mesh = makeShapeMesh(hull);
  ASSERT_TRUE(mesh);
  const auto edges = outlineOf(*mesh);
  EXPECT_EQ(edges.size(), 12u);
  EXPECT_NEAR(lengthOf(edges), 24, 1e-5);
}

TEST(Outline, ofATetrahedronAreItsSixEdges) {
  ShapeDef hull;
  hull.type = ShapeType::hull;
  hull.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto mesh = makeShapeMesh(hull);
  ASSERT_TRUE(mesh);
  const auto edges = outlineOf(*mesh);
  EXPECT_EQ(edges.size(), 6u);
  EXPECT_NEAR(lengthOf(edges), 3 + 3 * std::sqrt(2.0), 1e-5);
}

// A sheet that is folded in the middle: its rim, and the fold.
TEST(Outline, ofASurfaceHasItsRimAndFolds) {
  ShapeMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {2, 1, 0}, {2, 1, 1}};
  sheet.indices = {0, 2, 1, 0, 3, 2, 1, 2, 5, 1, 5, 4};
  const auto edges = outlineOf(sheet);
  EXPECT_EQ(edges.size(), 7u);
  EXPECT_NEAR(lengthOf(edges), 5 + 2 * std::sqrt(2.0), 1e-5);
}

}  // namespace
}  // namespace brickfall::viewer
