#include "viewer_window/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "appearance/draw_mesh.h"
#include "brickfall/geometry/shape_mesh.h"
#include "viewer_window/sun.h"

namespace brickfall::viewer {
namespace {

DrawMesh drawn(const ShapeMesh& mesh) {
  DrawMesh out{mesh.positions, mesh.normals, {}, mesh.indices};
  out.uvs.resize(mesh.positions.size());
  return out;
}

Vec3 placeOf(const VolumeVertex& vertex) { return {vertex.x, vertex.y, vertex.z}; }

// Area of the shadow on a plane across the sun's rays: that of the lit faces, seen from the sun.
double shadowArea(const ShadowGeometry& geometry, Vec3 sun) {
  double area = 0;
  for (std::size_t i = 0; i < geometry.caps().size(); i += 3) {
    const Vec3 a = placeOf(geometry.vertices()[geometry.caps()[i]]),
               b = placeOf(geometry.vertices()[geometry.caps()[i + 1]]),
               c = placeOf(geometry.vertices()[geometry.caps()[i + 2]]);
    area += 0.5 * dot(cross(b - a, c - a), sun);
  }
  return area;
}

// Sides and caps together have each edge twice, once in each direction: nothing leaks out of a volume. All edges to the point at
// infinity are between two sides.
void expectClosed(const ShadowGeometry& geometry) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const auto add = [&](std::span<const std::uint32_t> triangles) {
    for (std::size_t i = 0; i < triangles.size(); i++) {
      const std::uint32_t from = triangles[i], to = triangles[i % 3 == 2 ? i - 2 : i + 1];
      edges[{from, to}]++;
      edges[{to, from}]--;
    }
  };
  add(geometry.sides());
  add(geometry.caps());
  for (const auto& [edge, sum] : edges) EXPECT_EQ(sum, 0) << edge.first << " to " << edge.second;
}

TEST(Silhouette, ofABoxUnderTheZenithIsItsTop) {
  const ShadowShape box(drawn(boxMesh({1, 2, 3})));
  EXPECT_TRUE(box.closed());
  EXPECT_EQ(box.corners().size(), 8u);
  EXPECT_EQ(box.faces().size(), 12u);
  EXPECT_EQ(box.edges().size(), 18u);
  ShadowGeometry geometry;
  geometry.clear();
  geometry.add(box, {{5, 6, 7}, {}}, {1, 1, 1}, {0, 1, 0});
  EXPECT_EQ(geometry.caps().size(), 6u);       // two triangles
  EXPECT_EQ(geometry.sides().size(), 4u * 3);  // four edges, a triangle each to the point at infinity
  EXPECT_EQ(geometry.vertices()[0].w, 0);
  for (const std::uint32_t corner : geometry.caps()) EXPECT_FLOAT_EQ(geometry.vertices()[corner].y, 8);
  EXPECT_NEAR(shadowArea(geometry, {0, 1, 0}), 2 * 6, 1e-6);
  expectClosed(geometry);
}

TEST(Silhouette, turnedBodiesCloseAndHaveTheirShadow) {
  const Vec3 sun = towardsSun({1, 0.3, 2});
  EXPECT_NEAR(length(sun), 1, 1e-12);
  const ShadowShape box(drawn(boxMesh({0.1075, 0.0325, 0.05125}))), ball(drawn(sphereMesh(1, {16, 32})));
  EXPECT_TRUE(ball.closed());
  for (int i = 0; i < 20; i++) {
    const Transform pose{{0.1 * i, 1, -0.2 * i}, quatFromRotationVector({0.3 * i, 1.1 - 0.2 * i, 0.05 * i * i})};
    ShadowGeometry geometry;
    geometry.clear();
    geometry.add(box, pose, {1, 1, 1}, sun);
    // Of a box: the sum over its pairs of faces.
    const Vec3 local = rotate(conjugate(pose.rotation), sun);
    const double expected = 4 * (std::fabs(local.x) * 0.0325 * 0.05125 + std::fabs(local.y) * 0.1075 * 0.05125 +
                                 std::fabs(local.z) * 0.1075 * 0.0325);
    EXPECT_NEAR(shadowArea(geometry, sun), expected, 1e-6);
    expectClosed(geometry);
    geometry.clear();
    geometry.add(ball, pose, {0.3, 0.3, 0.3}, sun);
    EXPECT_NEAR(shadowArea(geometry, sun), 3.14159 * 0.09, 0.004);
    expectClosed(geometry);
  }
}

TEST(Silhouette, manyBodiesShareOnePointAtInfinity) {
  const ShadowShape box(drawn(boxMesh({1, 1, 1})));
  ShadowGeometry geometry;
  geometry.clear();
  for (int i = 0; i < 3; i++) geometry.add(box, {{4.0 * i, 0, 0}, {}}, {1, 1, 1}, {0, 1, 0});
  EXPECT_EQ(geometry.vertices().size(), 1u + 3 * 8);
  EXPECT_NEAR(shadowArea(geometry, {0, 1, 0}), 12, 1e-6);
  expectClosed(geometry);
}

TEST(Silhouette, aSurfaceWithARimCastsNone) {
  DrawMesh sheet;
  sheet.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  sheet.indices = {0, 1, 2};
  const ShadowShape shape(sheet);
  EXPECT_FALSE(shape.closed());
  ShadowGeometry geometry;
  geometry.clear();
  geometry.add(shape, {}, {1, 1, 1}, {0, 1, 0});
  EXPECT_TRUE(geometry.caps().empty());
  EXPECT_TRUE(geometry.sides().empty());
}

TEST(Sun, standsAsideOfTheFirstCameraAndAboveTheGround) {
  for (const Vec3 from : {Vec3{0, 1, 3}, Vec3{2, 0, -1}, Vec3{0, 5, 0}}) {
    const Vec3 sun = towardsSun(from);
    EXPECT_GT(sun.y, 0.5);
    const Vec3 level = normalized(Vec3{from.x, 0, from.z});
    if (level == Vec3{}) continue;
    EXPECT_GT(dot(level, sun), 0.2);  // what is looked at first is lit
  }
}

TEST(Silhouette, ofABallIsARoundOneWhereItsShadingEnds) {
  const Vec3 sun = towardsSun({1, 0.5, 2}), middle{3, 1, -2};
  ShadowGeometry geometry;
  geometry.clear();
  geometry.addBall(middle, 0.2, sun);
  expectClosed(geometry);
  const double circle = 3.14159265358979 * 0.04;
  EXPECT_GT(shadowArea(geometry, sun), circle);
  EXPECT_LT(shadowArea(geometry, sun), 1.01 * circle);
  for (std::size_t i = 1; i < geometry.vertices().size(); i++)  // the first is the point at infinity
    EXPECT_NEAR(dot(placeOf(geometry.vertices()[i]) - middle, sun), 0, 1e-6);
}

TEST(Silhouette, drawnOutEdgesAreThoseOfTheBox) {
  const Vec3 half{0.1, 0.03, 0.05}, sun = towardsSun({1, 0.5, 2});
  const ShadowShape box(drawn(boxMesh(half))), cut(drawn(appearance::chamferedBoxMesh(half, 0.002)));
  const auto areaOf = [&](const ShadowShape& shape, double sharpened) {
    ShadowGeometry geometry;
    geometry.clear();
    geometry.add(shape, {}, {1, 1, 1}, sun, sharpened);
    expectClosed(geometry);
    return shadowArea(geometry, sun);
  };
  EXPECT_LT(areaOf(cut, 0), areaOf(box, 0) * 0.99);
  EXPECT_NEAR(areaOf(cut, 0.0022), areaOf(box, 0), 1e-6);
}

}  // namespace
}  // namespace brickfall::viewer
