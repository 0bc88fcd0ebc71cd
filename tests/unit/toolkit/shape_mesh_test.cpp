// Meshes enclose the volume of their shape, seen from outside, with normals that belong to their triangles.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "brickfall/geometry/shape_mesh.h"

namespace brickfall {
namespace {

Vec3 at(const std::vector<std::array<float, 3>>& list, std::uint32_t k) { return {list[k][0], list[k][1], list[k][2]}; }

// Positive only if the triangles turn outwards.
double volumeOf(const ShapeMesh& mesh) {
  double six = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    Vec3 a = at(mesh.positions, mesh.indices[t]), b = at(mesh.positions, mesh.indices[t + 1]),
         c = at(mesh.positions, mesh.indices[t + 2]);
    six += dot(a, cross(b, c));
  }
  return six / 6;
}

// cosine: how far a smooth normal may be from its triangle's.
void expectSound(const ShapeMesh& mesh, double cosine = 0.7) {
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
      EXPECT_GT(dot(n, normalized(normal)), cosine);
    }
  }
}

TEST(ShapeMesh, BoxHasTwentyFourCornersAndItsVolume) {
  ShapeMesh mesh = boxMesh({0.1, 0.2, 0.3});
  expectSound(mesh);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.indices.size(), 36u);
  EXPECT_NEAR(volumeOf(mesh), 8 * 0.1 * 0.2 * 0.3, 1e-7);
}

TEST(ShapeMesh, RoundShapesComeCloseToTheirVolume) {
  const double pi = std::numbers::pi;
  ShapeMesh sphere = sphereMesh(0.5);
  expectSound(sphere);
  EXPECT_NEAR(volumeOf(sphere), 4.0 / 3 * pi * 0.125, 0.03 * 4.0 / 3 * pi * 0.125);
  ShapeMesh capsule = capsuleMesh(0.5, 0.7);
  expectSound(capsule);
  double exact = 4.0 / 3 * pi * 0.125 + pi * 0.25 * 1.4;
  EXPECT_NEAR(volumeOf(capsule), exact, 0.03 * exact);
  double top = 0;
  for (const auto& p : capsule.positions) top = std::max(top, double(p[1]));
  EXPECT_NEAR(top, 1.2, 1e-6);
}

TEST(ShapeMesh, DrumsAndConesAreClosedWithFlatCapsAndSlantedSides) {
  for (double top : {0.5, 0.2, 0.0}) {
    const ShapeMesh mesh = top == 0.5 ? cylinderMesh(0.5, 0.7) : coneMesh(0.5, top, 0.7);
    expectSound(mesh, 0.99);
    const double exact = std::numbers::pi * 1.4 / 3 * (0.25 + 0.5 * top + top * top);
    EXPECT_NEAR(volumeOf(mesh), exact, 0.01 * exact);
    const double rise = 1.4, inward = 0.5 - top, up = inward / std::sqrt(rise * rise + inward * inward);
    int caps = 0;
    for (const auto& n : mesh.normals) {
      caps += std::fabs(n[1]) == 1;
      if (std::fabs(n[1]) != 1) {
        EXPECT_NEAR(n[1], up, 1e-6);
      }
    }
    EXPECT_EQ(caps, top > 0 ? 64 : 32);
  }
}

TEST(ShapeMesh, HullOfACubeHasSixSquareFaces) {
  std::vector<Vec3> points;
  for (double x : {-1.0, 1.0})
    for (double y : {-1.0, 1.0})
      for (double z : {-1.0, 1.0}) points.push_back({x, y, z});
  points.push_back({1, 0, 0});    // on a face
  points.push_back({1, 1, 0});    // on an edge
  points.push_back({0.2, 0, 0});  // inside
  Result<ShapeMesh> made = hullMesh(points);
  ASSERT_TRUE(made) << made.error().message;
  const ShapeMesh& mesh = *made;
  expectSound(mesh);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.indices.size(), 36u);
  EXPECT_NEAR(volumeOf(mesh), 8, 1e-6);
}

TEST(ShapeMesh, RandomHullsAreClosed) {
  std::mt19937_64 random(3);
  auto number = [&] { return double(random() >> 11) * 0x1p-53 * 2 - 1; };
  for (int round = 0; round < 40; round++) {
    std::vector<Vec3> points;
    int count = 4 + round;
    while (int(points.size()) < count) {
      Vec3 p{number(), number(), number()};
      if (length(p) > 0.1 && length(p) < 1) points.push_back(round % 2 ? normalized(p) : p);
    }
    Result<ShapeMesh> made = hullMesh(points);
    ASSERT_TRUE(made) << made.error().message;
    const ShapeMesh& mesh = *made;
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

std::vector<std::array<double, 8>> cornersOf(const ShapeMesh& mesh) {
  std::vector<std::array<double, 8>> out;
  for (std::size_t k = 0; k < mesh.positions.size(); k++) {
    const auto &p = mesh.positions[k], &n = mesh.normals[k];
    out.push_back({p[0], p[1], p[2], n[0], n[1], n[2], mesh.uvs[k][0], mesh.uvs[k][1]});
  }
  return out;
}

// On a flat face a texture keeps its scale and is not mirrored: going one metre along it is one unit of u and v, v down.
void expectTextureTrue(const ShapeMesh& mesh) {
  auto all = cornersOf(mesh);
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto &a = all[mesh.indices[t]], &b = all[mesh.indices[t + 1]], &c = all[mesh.indices[t + 2]];
    Vec3 p{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, q{c[0] - a[0], c[1] - a[1], c[2] - a[2]}, n{a[3], a[4], a[5]};
    double pu = b[6] - a[6], pv = b[7] - a[7], qu = c[6] - a[6], qv = c[7] - a[7];
    EXPECT_NEAR(dot(p, p), pu * pu + pv * pv, 1e-4);
    EXPECT_NEAR(dot(q, q), qu * qu + qv * qv, 1e-4);
    EXPECT_NEAR(dot(n, cross(p, q)), -(pu * qv - pv * qu), 1e-4);
  }
}

TEST(ShapeMesh, TexturesAreTrueToScaleOnFlatFaces) {
  expectTextureTrue(boxMesh({0.1, 0.7, 0.3}));
  expectTextureTrue(*hullMesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0.5}}));
  expectTextureTrue(planeMesh(3, 0.5));
}

TEST(ShapeMesh, TexturesGoOnceAroundRoundShapesAndDownThem) {
  ShapeMesh capsule = capsuleMesh(0.5, 2, {8, 12});
  expectSound(capsule);
  const double meridian = std::numbers::pi * 0.5 + 4;
  for (std::size_t k = 0; k < capsule.positions.size(); k++) {
    double y = capsule.positions[k][1], polar = std::acos(double(capsule.normals[k][1]));
    double along = y >= 2 ? 0.5 * polar : 0.5 * polar + 4;
    if (y < 2 && y > -2) along = 0.5 * std::numbers::pi / 2 + 2 - y;
    EXPECT_NEAR(capsule.uvs[k][1], along / meridian, 1e-5);
  }
  // The seam: equal places at u = 0 and u = 1.
  ShapeMesh sphere = sphereMesh(1, {4, 6});
  for (std::size_t row = 0; row < 5; row++) {
    EXPECT_EQ(sphere.positions[row * 7], sphere.positions[row * 7 + 6]);
    EXPECT_EQ(sphere.uvs[row * 7][0], 0);
    EXPECT_EQ(sphere.uvs[row * 7 + 6][0], 1);
  }
}

TEST(ShapeMesh, DetailIsPutIntoItsRange) {
  expectSound(sphereMesh(1, {0, 0}), 0.4);
  expectSound(sphereMesh(1, {-5, -5}), 0.4);
  expectSound(capsuleMesh(1, 1, {3, 3}), 0.4);
  EXPECT_EQ(sphereMesh(1, {2, 3}).indices.size(), 18u);
}

TEST(ShapeMesh, EveryShapeHasOne) {
  ShapeDef shape;
  shape.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (ShapeType type : {ShapeType::box, ShapeType::sphere, ShapeType::capsule, ShapeType::hull, ShapeType::plane,
                         ShapeType::cylinder, ShapeType::cone}) {
    shape.type = type;
    Result<ShapeMesh> mesh = makeShapeMesh(shape);
    ASSERT_TRUE(mesh) << mesh.error().message;
    expectSound(*mesh);
    EXPECT_GT(volumeOf(*mesh), 0.1);
  }
}

TEST(ShapeMesh, BadShapesAreErrorValues) {
  auto errorOf = [](const ShapeDef& shape) {
    Result<ShapeMesh> mesh = makeShapeMesh(shape);
    return mesh ? std::string() : mesh.error().message;
  };
  ShapeDef box;
  box.halfExtents.y = std::nan("");
  EXPECT_NE(errorOf(box).find("halfExtents"), std::string::npos);
  ShapeDef sphere;
  sphere.type = ShapeType::sphere;
  sphere.radius = 0;
  EXPECT_NE(errorOf(sphere).find("radius: found 0"), std::string::npos);
  ShapeDef capsule;
  capsule.type = ShapeType::capsule;
  capsule.halfHeight = -1;
  EXPECT_NE(errorOf(capsule).find("halfHeight"), std::string::npos);
  ShapeDef hull;
  hull.type = ShapeType::hull;
  for (std::vector<Vec3> points : {std::vector<Vec3>{},
                                   {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                                   {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0.3, 0, 0.4}},
                                   {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}}) {
    hull.vertices = points;
    EXPECT_NE(errorOf(hull).find("vertices"), std::string::npos);
  }
}

}  // namespace
}  // namespace brickfall
