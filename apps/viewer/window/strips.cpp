#include "viewer_window/strips.h"

namespace brickfall::viewer {

void giveStripsOneFace(DrawMesh& mesh, Vec3 half) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t first = mesh.indices[i];
    const std::array<float, 3> outwards = mesh.normals[first];
    const int axis = int(mesh.uvs[first][2]), u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t k = 1; k < 3; k++) {
      const std::uint32_t corner = mesh.indices[i + k];
      if (int(mesh.uvs[corner][2]) == axis) continue;
      const std::array<float, 3> at = mesh.positions[corner], normal = mesh.normals[corner];
      mesh.indices[i + k] = std::uint32_t(mesh.positions.size());
      mesh.positions.push_back(at);
      mesh.normals.push_back(normal);
      // As boxMesh lays it.
      mesh.uvs.push_back({(float(half[u]) + at[std::size_t(u)] * outwards[std::size_t(axis)]) / (2 * kBrickHalf[u]),
                          (float(half[v]) - at[std::size_t(v)]) / (2 * kBrickHalf[v]), float(axis)});
    }
  }
}

}  // namespace brickfall::viewer
