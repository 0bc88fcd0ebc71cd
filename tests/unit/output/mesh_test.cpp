// Meshes enclose the volume of their shape, seen from outside, with normals that belong to their triangles.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "output/mesh.h"

namespace brickfall {
namespace {

Vec3 at(const std::vector<std::array<float, 3>>& list, std::uint32_t k) { return {list[k][0], list[k][1], list[k][2]}; }

// Positive only if the triangles turn outwards.
double volumeOf(const Mesh& mesh) {
  double six = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    Vec3 a = at(mesh.positions, mesh.indices[t]), b = at(mesh.positions, mesh.indices[t + 1]),
         c = at(mesh.positions, mesh.indices[t + 2]);
    six += dot(a, cross(b, c));
  }
  return six / 6;
}

void expectSound(const Mesh& mesh) {
  ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
  ASSERT_EQ(mesh.positions.size(), mesh.uvs.size());
  ASSERT_EQ(mesh.indices.size() % 3, 0u);
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    for (std::size_t k = 0; k < 3; k++) ASSERT_LT(mesh.indices[t + k], mesh.positions.size());
    Vec3 a = at(mesh.positions, mesh.indices[t]), b = at(mesh.positions, mesh.indices[t + 1]),
         c = at(mesh.positions, mesh.indices[t + 2]);
    Vec3 normal = cross(b - a, c - a);
    EXPECT_GT(length(normal), 0);
    for (std::size_t k = 0; k < 3; k++) {
      Vec3 n = at(mesh.normals, mesh.indices[t + k]);
      EXPECT_NEAR(length(n), 1, 1e-5);
      EXPECT_GT(dot(n, normalized(normal)), 0.7);
    }
  }
}

TEST(Mesh, BoxHasTwentyFourCornersAndItsVolume) {
  Mesh mesh = boxMesh({0.1, 0.2, 0.3});
  expectSound(mesh);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.indices.size(), 36u);
  EXPECT_NEAR(volumeOf(mesh), 8 * 0.1 * 0.2 * 0.3, 1e-7);
}

TEST(Mesh, RoundShapesComeCloseToTheirVolume) {
  const double pi = std::numbers::pi;
  Mesh sphere = sphereMesh(0.5);
  expectSound(sphere);
  EXPECT_NEAR(volumeOf(sphere), 4.0 / 3 * pi * 0.125, 0.03 * 4.0 / 3 * pi * 0.125);
  Mesh capsule = capsuleMesh(0.5, 0.7);
  expectSound(capsule);
  double exact = 4.0 / 3 * pi * 0.125 + pi * 0.25 * 1.4;
  EXPECT_NEAR(volumeOf(capsule), exact, 0.03 * exact);
  double top = 0;
  for (const auto& p : capsule.positions) top = std::max(top, double(p[1]));
  EXPECT_NEAR(top, 1.2, 1e-6);
}

TEST(Mesh, HullOfACubeHasSixSquareFaces) {
  std::vector<Vec3> points;
  for (double x : {-1.0, 1.0})
    for (double y : {-1.0, 1.0})
      for (double z : {-1.0, 1.0}) points.push_back({x, y, z});
  points.push_back({1, 0, 0});    // on a face
  points.push_back({1, 1, 0});    // on an edge
  points.push_back({0.2, 0, 0});  // inside
  Mesh mesh = hullMesh(points);
  expectSound(mesh);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.indices.size(), 36u);
  EXPECT_NEAR(volumeOf(mesh), 8, 1e-6);
}

TEST(Mesh, RandomHullsAreClosed) {
  std::mt19937_64 random(3);
  auto number = [&] { return double(random() >> 11) * 0x1p-53 * 2 - 1; };
  for (int round = 0; round < 40; round++) {
    std::vector<Vec3> points;
    int count = 4 + round;
    while (int(points.size()) < count) {
      Vec3 p{number(), number(), number()};
      if (length(p) > 0.1 && length(p) < 1) points.push_back(round % 2 ? normalized(p) : p);
    }
    Mesh mesh = hullMesh(points);
    expectSound(mesh);
    // Closed: the directed areas cancel; and every point is inside or on it.
    Vec3 sum;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      Vec3 a = at(mesh.positions, mesh.indices[t]), b = at(mesh.positions, mesh.indices[t + 1]),
           c = at(mesh.positions, mesh.indices[t + 2]), normal = cross(b - a, c - a);
      sum += normal;
      for (Vec3 p : points) EXPECT_LE(dot(normalized(normal), p - a), 1e-4) << "round " << round;
    }
    EXPECT_LE(length(sum), 1e-4) << "round " << round;
    EXPECT_GT(volumeOf(mesh), 0) << "round " << round;
  }
}

TEST(Mesh, FlatPointsGiveNoMesh) {
  EXPECT_TRUE(hullMesh({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0.3, 0, 0.4}}).indices.empty());
  EXPECT_TRUE(hullMesh({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).indices.empty());
  EXPECT_TRUE(hullMesh({}).indices.empty());
}

}  // namespace
}  // namespace brickfall
