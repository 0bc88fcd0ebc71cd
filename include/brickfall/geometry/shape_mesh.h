// Triangle meshes of shapes, in the shape's frame, ready to draw: positions, normals, texture coordinates. Flat faces have
// corners of their own, so that edges stay sharp (a box: 24 vertices, 12 triangles); round faces share smooth normals.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "brickfall/result.h"
#include "brickfall/shapes.h"

namespace brickfall {

class TriangleMesh;  // triangle_mesh.h

struct ShapeMesh {
  std::vector<std::array<float, 3>> positions, normals;  // m; unit, outwards
  // Flat faces: 1 = one metre, so that bricks of all sizes wear one texture. Round ones: u once around, v from the top
  // (0) to the bottom (1) along the surface.
  std::vector<std::array<float, 2>> uvs;
  std::vector<std::uint32_t> indices;  // triangles, counter-clockwise seen from outside
};

// How finely round shapes are divided. The chord misses the sphere by radius * (1 - cos(pi / sectors)): 0.5 % at 32.
struct RoundDetail {
  int rings = 16;    // from pole to pole, even, 2 .. 1024
  int sectors = 32;  // around, 3 .. 2048
};

// A plane becomes a slab of this half size, its top at y = 0.
constexpr double kPlaneHalfSize = 50, kPlaneHalfDepth = 0.25;  // m

// Any shape, its fields checked: lengths finite and above 0, a hull that encloses a volume.
Result<ShapeMesh> makeShapeMesh(const ShapeDef& shape, RoundDetail detail = {});

// The parts. Lengths are taken as they are; a detail out of its range is put to the nearest end.
ShapeMesh boxMesh(Vec3 halfExtents);
ShapeMesh sphereMesh(double radius, RoundDetail detail = {});
ShapeMesh capsuleMesh(double radius, double halfHeight, RoundDetail detail = {});
ShapeMesh cylinderMesh(double radius, double halfHeight, RoundDetail detail = {});
ShapeMesh coneMesh(double radius, double topRadius, double halfHeight, RoundDetail detail = {});
// Faces of the convex hull as the engine has it: at most 64 corners. The errors are those of the shape: too few points,
// not finite, all in a plane, too many corners.
Result<ShapeMesh> hullMesh(std::span<const Vec3> vertices);
ShapeMesh planeMesh(double halfSize = kPlaneHalfSize, double halfDepth = kPlaneHalfDepth);
// Smooth where faces meet at less than some 40 degrees from their mean, else with an edge; seen from the front.
ShapeMesh surfaceMesh(const TriangleMesh& mesh);

// Adds `part` seen through `pose`.
void append(ShapeMesh& mesh, const ShapeMesh& part, const Transform& pose);

}  // namespace brickfall
