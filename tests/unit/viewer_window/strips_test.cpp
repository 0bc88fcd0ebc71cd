// Dots along the joints of bricks: a strip along an edge ran from the place of one texture to that of another.
#include "viewer_window/strips.h"

#include <gtest/gtest.h>

#include <cmath>

#include "appearance/draw_mesh.h"

namespace brickfall::viewer {
namespace {

TEST(Strips, EachTriangleWearsOneTextureAtNoLargerScaleThanItsFaces) {
  const Vec3 half{0.1075, 0.0325, 0.05125};
  const ShapeMesh box = appearance::chamferedBoxMesh(half);
  DrawMesh mesh{box.positions, box.normals, {}, box.indices};
  for (std::size_t i = 0; i < box.uvs.size(); i++) {
    int axis = 0;
    for (int k = 1; k < 3; k++)
      axis = std::fabs(mesh.normals[i][std::size_t(k)]) > std::fabs(mesh.normals[i][std::size_t(axis)]) ? k : axis;
    mesh.uvs.push_back({box.uvs[i][0] / (2 * kBrickHalf[(axis + 1) % 3]),
                        box.uvs[i][1] / (2 * kBrickHalf[(axis + 2) % 3]), float(axis)});
  }
  giveStripsOneFace(mesh, half);
  ASSERT_EQ(mesh.indices.size(), box.indices.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    for (std::size_t k = 0; k < 3; k++) {
      const std::uint32_t a = mesh.indices[t + k], b = mesh.indices[t + (k + 1) % 3];
      EXPECT_EQ(mesh.positions[a], box.positions[box.indices[t + k]]);
      EXPECT_EQ(mesh.normals[a], box.normals[box.indices[t + k]]);
      const int axis = int(mesh.uvs[a][2]);
      ASSERT_EQ(axis, int(mesh.uvs[b][2])) << "triangle " << t / 3;
      // m on the texture, of what the mesh has there: no more, but for the strips beside it.
      double worn = 0, there = 0;
      for (std::size_t i : {0, 1}) {
        const double along = (mesh.uvs[a][i] - mesh.uvs[b][i]) * 2 * kBrickHalf[(std::size_t(axis) + 1 + i) % 3];
        worn += along * along;
      }
      for (std::size_t i = 0; i < 3; i++) there += std::pow(mesh.positions[a][i] - mesh.positions[b][i], 2);
      EXPECT_LE(std::sqrt(worn), std::sqrt(there) + 3 * appearance::kChamfer) << "triangle " << t / 3;
    }
}

}  // namespace
}  // namespace brickfall::viewer
