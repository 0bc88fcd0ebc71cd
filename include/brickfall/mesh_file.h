// Reading triangle meshes from files: Wavefront OBJ, glTF 2.0 (.gltf, .glb), heights over a grid (.csv). docs/mesh.md says what of each is read.
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brickfall/math.h"
#include "brickfall/result.h"

namespace brickfall {

// What a file holds, all of its parts in one frame; TriangleMesh::create checks and mends it.
struct MeshFileData {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise seen from the front
};

// Errors name the file and the line ("hill.obj:12: ...") or the field ("hill.gltf: accessors[3].count: ..."), what was found
// and what was expected. Never an exception, whatever the bytes are.
Result<MeshFileData> readObj(std::string_view text, const std::string& name);

// Gives the bytes of a file named in a .gltf, relative to it.
using MeshFileOpener = std::function<Result<std::vector<std::byte>>(const std::string& relativePath)>;
Result<MeshFileData> readGltf(std::span<const std::byte> bytes, const std::string& name,
                              const MeshFileOpener& open = {});

// Ground from heights (geometry/height_field.h), a metre apart.
Result<MeshFileData> readHeights(std::string_view text, const std::string& name);

// By the ending: .obj, .gltf, .glb, .csv (any case). A file of at most 256 MiB; buffers of a .gltf lie in its folder or below.
Result<MeshFileData> loadMeshFile(const std::string& path);

}  // namespace brickfall
