// Triangle meshes of shapes, in the shape's frame: flat faces have their own corners, round ones share smooth normals.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "brickfall/shapes.h"

namespace brickfall {

struct Mesh {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> uvs;  // 1 = one metre along a flat face; 0 .. 1 around round ones
  std::vector<std::uint32_t> indices;     // triangles, counter-clockwise seen from outside
};

// A plane becomes a slab of this half size, its top at y = 0.
constexpr double kPlaneHalfSize = 50, kPlaneHalfDepth = 0.25;  // m

// A hull whose points span no volume gives an empty mesh.
Mesh meshOf(const ShapeDef& shape);
Mesh boxMesh(Vec3 halfExtents);
Mesh sphereMesh(double radius);
Mesh capsuleMesh(double radius, double halfHeight);
Mesh hullMesh(const std::vector<Vec3>& vertices);

// Adds `part` seen through `pose`.
void append(Mesh& mesh, const Mesh& part, const Transform& pose);

}  // namespace brickfall
