// Triangles to draw: closed, facing outwards, inside the collider.
#include "appearance/draw_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace brickfall::appearance {
namespace {

Vec3 at(const std::vector<std::array<float, 3>>& list, std::uint32_t i) { return {list[i][0], list[i][1], list[i][2]}; }

TEST(DrawMesh, ChamferedBoxIsClosedAndFacesOutwards) {
  const Vec3 half{0.1075, 0.0325, 0.05125};
  const ShapeMesh mesh = chamferedBoxMesh(half);
  ASSERT_EQ(mesh.positions.size(), 24u);
  ASSERT_EQ(mesh.indices.size(), 3u * 44);
  double volume = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::uint32_t i[3] = {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
    const Vec3 a = at(mesh.positions, i[0]), b = at(mesh.positions, i[1]), c = at(mesh.positions, i[2]);
    const Vec3 normal = cross(b - a, c - a);
    EXPECT_GT(dot(normal, a + b + c), 0);
    for (std::uint32_t k : i) EXPECT_GT(dot(normalized(normal), at(mesh.normals, k)), 0.5);
    volume += dot(a, cross(b, c)) / 6;
    for (int k = 0; k < 3; k++) edges[{i[k], i[(k + 1) % 3]}]++;
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "each edge is met from both sides";
  }
  EXPECT_LT(volume, 8 * half.x * half.y * half.z);
  EXPECT_GT(volume, 0.99 * 8 * half.x * half.y * half.z);
}

TEST(DrawMesh, StaysInsideTheColliderAndTouchesItsFaces) {
  for (Vec3 half : {Vec3{0.1075, 0.0325, 0.05125}, Vec3{0.002, 0.5, 30}, Vec3{0.1, 0.1, 0.1}}) {
    const ShapeMesh mesh = chamferedBoxMesh(half);
    for (std::uint32_t i = 0; i < 24; i++) {
      int touched = 0;
      for (int k = 0; k < 3; k++) {
        EXPECT_LE(std::fabs(mesh.positions[i][std::size_t(k)]), float(half[k]));
        touched += std::fabs(mesh.positions[i][std::size_t(k)]) == float(half[k]);
      }
      EXPECT_EQ(touched, 1);
    }
  }
}

TEST(DrawMesh, EveryShapeHasTrianglesNormalsAndTextureCoordinates) {
  ShapeDef shape;
  shape.vertices = {{-0.1, -0.1, -0.1}, {0.1, -0.1, -0.1}, {0.1, -0.1, 0.1}, {-0.1, -0.1, 0.1}, {0, 0.1, 0}};
  for (ShapeType type : {ShapeType::box, ShapeType::sphere, ShapeType::capsule, ShapeType::hull, ShapeType::plane}) {
    shape.type = type;
    const Result<ShapeMesh> mesh = makeDrawMesh(shape);
    ASSERT_TRUE(mesh) << int(type);
    EXPECT_EQ(mesh->normals.size(), mesh->positions.size());
    EXPECT_EQ(mesh->uvs.size(), mesh->positions.size());
    EXPECT_GE(mesh->indices.size(), 18u);
  }
  shape.type = ShapeType::box;
  shape.halfExtents.y = -1;
  EXPECT_FALSE(makeDrawMesh(shape));
}

}  // namespace
}  // namespace brickfall::appearance
