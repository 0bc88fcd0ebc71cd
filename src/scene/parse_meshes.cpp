// shape = "mesh": a file beside the scene file, read once for each scale.
#include <filesystem>

#include "brickfall/geometry/mesh_tree.h"
#include "brickfall/limits.h"
#include "brickfall/mesh_file.h"
#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

// The mesh, or why not.
Result<MeshTree> load(const std::string& path, Vec3 scale) {
  Result<MeshFileData> file = loadMeshFile(path);
  if (!file) return file.error();
  for (Vec3& v : file->vertices) v = scaled(v, scale);
  Result<TriangleMesh> mesh = TriangleMesh::create(file->vertices, file->indices);
  if (!mesh) return Error{mesh.error().code, path + ": " + mesh.error().message};
  Vec3 reach = max(abs(mesh->bounds().lower), abs(mesh->bounds().upper));
  if (!(reach.x <= limits::kLargestSize && reach.y <= limits::kLargestSize && reach.z <= limits::kLargestSize))
    return Error{ErrorCode::invalidArgument, path + ": found coordinates beyond " +
                                                 std::to_string(int(limits::kLargestSize)) +
                                                 " m, expected a smaller mesh or scale"};
  return MeshTree::build(std::move(mesh).value());
}

}  // namespace

std::shared_ptr<const MeshTree> readMesh(SceneBuild& build, TableReader& reader) {
  std::string file;
  Vec3 scale{1, 1, 1};
  bool scaleRead = reader.vector("scale", scale);
  if (!reader.text("file", file)) {
    if (!reader.has("file")) reader.error("file", "not given, expected the file of the mesh");
    return nullptr;
  }
  if (reader.has("scale") && !scaleRead) return nullptr;
  std::string path = (std::filesystem::path(build.context.file).parent_path() / file).string();
  std::string key = path + "|" + numberText(scale.x) + "|" + numberText(scale.y) + "|" + numberText(scale.z);
  auto [known, added] = build.meshes.try_emplace(key);
  if (!added) return known->second;  // if it could not be read, that was said at the first
  Result<MeshTree> tree = load(path, scale);
  if (tree)
    known->second = std::make_shared<MeshTree>(std::move(tree).value());
  else
    reader.error("file", tree.error().message);
  return known->second;
}

}  // namespace brickfall::scene
