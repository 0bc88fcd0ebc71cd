// libFuzzer: any bytes as .gltf or .glb, and, since lengths and JSON keep most of them out there, as the JSON or the binary part
// of a sound .glb.
#include <cstring>
#include <vector>

#include "brickfall/geometry/triangle_mesh.h"
#include "brickfall/mesh_file.h"
#include "fuzz/fuzz_check.h"

namespace {

using Bytes = std::vector<std::byte>;

void put(Bytes& out, std::uint32_t v) {
  for (int k = 0; k < 4; k++) out.push_back(std::byte(v >> (8 * k) & 255));
}

Bytes toGlb(const void* json, std::size_t jsonSize, std::size_t binarySize) {
  Bytes out;
  put(out, 0x46546C67);
  put(out, 2);
  put(out, std::uint32_t(12 + 8 + jsonSize + 8 + binarySize));
  put(out, std::uint32_t(jsonSize));
  put(out, 0x4E4F534A);
  out.resize(out.size() + jsonSize);
  if (jsonSize > 0) std::memcpy(out.data() + out.size() - jsonSize, json, jsonSize);
  put(out, std::uint32_t(binarySize));
  put(out, 0x004E4942);
  for (std::size_t i = 0; i < binarySize; i++) out.push_back(std::byte(i * 37 & 255));
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace brickfall;
  using fuzz::require;
  if (size == 0) return 0;
  Bytes bytes(size - 1);
  if (size > 1) std::memcpy(bytes.data(), data + 1, size - 1);
  if (data[0] % 2) bytes = toGlb(data + 1, size - 1, 256);
  auto opener = [](const std::string& name) -> Result<Bytes> {
    if (name.size() % 2) return Error{ErrorCode::inputOutput, "there is no such file"};
    return Bytes(name.size() * 16);
  };
  Result<MeshFileData> file = readGltf(bytes, "f.glb", opener);
  if (!file) {
    require(file.error().message.rfind("f.glb: ", 0) == 0, "an error without its file");
    return 0;
  }
  require(!file->indices.empty() && file->indices.size() % 3 == 0, "no whole triangles");
  for (std::uint32_t i : file->indices) require(i < file->vertices.size(), "an index without a vertex");
  (void)TriangleMesh::create(file->vertices, file->indices).ok();
  return 0;
}
