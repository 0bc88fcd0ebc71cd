// Meshes for tests and benches, made by rule: smooth and rough, closed and open, fine and coarse.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall::test {

struct MeshData {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
};

// Made of about `triangles` triangles. All about 1 m in radius, fronts outwards (upwards).
MeshData sphereMesh(int triangles);
MeshData torusMesh(int triangles);                       // radii 0.75 and 0.25
MeshData terrainMesh(int triangles);                     // 2 x 2, heights within +-0.25: hills of several wavelengths
MeshData statueMesh(int triangles);                      // a tall body with limbs, folds and a rough skin; closed
MeshData cubeMesh(double half = 0.5);                    // 12 triangles
MeshData gridMesh(int cellsX, int cellsZ, double cell);  // flat, at y = 0, around the origin, upwards
// Triangles in a ball with nothing to do with each other, needles among them.
MeshData soupMesh(int triangles, std::uint64_t seed);

MeshTree treeOf(const MeshData& data);  // ends the program if the mesh is refused

struct NamedMesh {
  std::string name;
  MeshData data;
};
std::vector<NamedMesh> sampleMeshes(int triangles);

}  // namespace brickfall::test
