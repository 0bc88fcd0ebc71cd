#include <algorithm>
#include <filesystem>
#include <fstream>

#include "brickfall/mesh_file.h"

namespace brickfall {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = std::uintmax_t(256) << 20;

Result<std::vector<std::byte>> readWhole(const fs::path& path) {
  auto failed = [&](const std::string& what) { return Error{ErrorCode::inputOutput, path.string() + ": " + what}; };
  std::error_code problem;
  fs::file_status status = fs::status(path, problem);
  if (!fs::exists(status)) return failed("there is no such file, expected a mesh");
  if (!fs::is_regular_file(status)) return failed("found something else, expected a file");
  std::uintmax_t size = fs::file_size(path, problem);
  if (problem || size > kMaxBytes) return failed("found a file of over 256 MiB, expected a smaller mesh");
  std::ifstream file(path, std::ios::binary);
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  if (file && size > 0) file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size));
  if (!file) return failed("the file can't be read");
  return bytes;
}

}  // namespace

Result<MeshFileData> loadMeshFile(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  bool obj = ending == ".obj", heights = ending == ".csv";
  if (!obj && !heights && ending != ".gltf" && ending != ".glb")
    return Error{ErrorCode::badFormat,
                 path + ": found the ending \"" + ending + "\", expected .obj, .gltf, .glb or .csv"};
  Result<std::vector<std::byte>> bytes = readWhole(path);
  if (!bytes) return bytes.error();
  const std::string_view text{reinterpret_cast<const char*>(bytes->data()), bytes->size()};
  if (obj) return readObj(text, path);
  if (heights) return readHeights(text, path);
  fs::path folder = fs::path(path).parent_path();
  return readGltf(*bytes, path, [&](const std::string& name) -> Result<std::vector<std::byte>> {
    fs::path relative(name);
    bool below = !name.empty() && relative.is_relative() && name.find(':') == std::string::npos &&
                 name.find('\0') == std::string::npos &&
                 std::none_of(relative.begin(), relative.end(), [](const fs::path& part) { return part == ".."; });
    if (!below) return Error{ErrorCode::badFormat, "expected a file in the folder of the .gltf or below"};
    return readWhole(folder / relative);
  });
}

}  // namespace brickfall
