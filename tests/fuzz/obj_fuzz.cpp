// libFuzzer: any text as an OBJ file. It is a mesh or has a reason why not; what is read is sound, and so is its tree.
#include "brickfall/geometry/mesh_tree.h"
#include "brickfall/mesh_file.h"
#include "fuzz/fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace brickfall;
  using fuzz::require;
  Result<MeshFileData> file = readObj({reinterpret_cast<const char*>(data), size}, "f.obj");
  if (!file) {
    require(file.error().message.rfind("f.obj", 0) == 0, "an error without its file");
    return 0;
  }
  for (std::uint32_t i : file->indices) require(i < file->vertices.size(), "an index without a vertex");
  Result<TriangleMesh> mesh = TriangleMesh::create(file->vertices, file->indices);
  if (!mesh) return 0;
  MeshTree tree = MeshTree::build(std::move(mesh).value());
  if (tree.mesh().count() <= 200) require(tree.validate().empty(), tree.validate());
  MeshTree other = tree;
  (void)overlappingFaces(tree, other, {{0.1, 0.2, 0.3}, {}});
  (void)meshDistance(tree, other, {{3, 0, 0}, {}});
  (void)tree.castRay({0, 10, 0}, {0, -1, 0}, 100);
  return 0;
}
