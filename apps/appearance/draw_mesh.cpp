#include "appearance/draw_mesh.h"

#include <algorithm>

namespace brickfall::appearance {
namespace {

// A corner's vertex on one of its three faces: boxes have 8 corners, numbered by the signs of x, y, z.
struct CornerVertices {
  std::uint32_t onFace[3] = {0, 0, 0};  // by axis of the face
};

void addTriangle(ShapeMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto at = [&](std::uint32_t i) {
    return Vec3{mesh.positions[i][0], mesh.positions[i][1], mesh.positions[i][2]};
  };
  // A box is convex about its middle, so outwards is away from it.
  const Vec3 normal = cross(at(b) - at(a), at(c) - at(a));
  if (dot(normal, at(a) + at(b) + at(c)) < 0) std::swap(b, c);
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

int cornerWith(const int signs[3]) { return (signs[0] > 0) + 2 * (signs[1] > 0) + 4 * (signs[2] > 0); }

}  // namespace

ShapeMesh chamferedBoxMesh(Vec3 half, double chamfer) {
  const double cut = std::clamp(chamfer, 0.0, 0.1 * std::min({half.x, half.y, half.z}));
  ShapeMesh mesh = boxMesh(half);
  CornerVertices corners[8];
  for (std::uint32_t i = 0; i < 24; i++) {
    int signs[3], axis = 0;
    for (int k = 0; k < 3; k++) {
      signs[k] = mesh.positions[i][std::size_t(k)] > 0 ? 1 : -1;
      if (mesh.normals[i][std::size_t(k)] != 0) axis = k;
    }
    corners[cornerWith(signs)].onFace[axis] = i;
    // Towards the middle of its face; the texture stays where it was. Rounded down: never outside the box.
    for (int k = 0; k < 3; k++)
      if (k != axis) mesh.positions[i][std::size_t(k)] = float(signs[k] * (half[k] - cut));
  }
  for (int axis = 0; axis < 3; axis++) {  // strips along the edges of this direction
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int su : {-1, 1})
      for (int sv : {-1, 1}) {
        int from[3], to[3];
        from[u] = to[u] = su;
        from[v] = to[v] = sv;
        from[axis] = -1;
        to[axis] = 1;
        const CornerVertices &a = corners[cornerWith(from)], &b = corners[cornerWith(to)];
        addTriangle(mesh, a.onFace[u], b.onFace[u], b.onFace[v]);
        addTriangle(mesh, a.onFace[u], b.onFace[v], a.onFace[v]);
      }
  }
  for (const CornerVertices& corner : corners) addTriangle(mesh, corner.onFace[0], corner.onFace[1], corner.onFace[2]);
  return mesh;
}

Result<ShapeMesh> makeDrawMesh(const ShapeDef& shape, RoundDetail detail) {
  Result<ShapeMesh> mesh = makeShapeMesh(shape, detail);  // which also checks the shape
  if (mesh && shape.type == ShapeType::box) return chamferedBoxMesh(shape.halfExtents);
  return mesh;
}

}  // namespace brickfall::appearance
