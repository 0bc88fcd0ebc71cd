#include "cli/result_folder.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/files.h"

namespace brickfall::cli {
namespace {

namespace fs = std::filesystem;

// The scene file whose results lie in a folder; empty: nobody knows.
std::string fileOf(const std::string& folder) {
  std::ifstream file(joinPath(folder, "summary.json"), std::ios::binary);
  if (!file.is_open()) return {};
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("file") || !json["file"].is_string()) return {};
  return json["file"].get<std::string>();
}

}  // namespace

std::string absolutePath(const std::string& file) {
  std::error_code error;
  if (file == "-") return file;
  const fs::path path = fs::weakly_canonical(file, error);
  return error ? file : path.string();
}

std::string resultFolder(const std::string& name, const std::string& file) {
  const std::string first = joinPath("out", name), own = absolutePath(file);
  for (int number = 1; number < 1000; number++) {
    const std::string folder = number == 1 ? first : first + "-" + std::to_string(number);
    const std::string other = fileOf(folder);
    if (other.empty() || other == own) return folder;
  }
  return first;
}

}  // namespace brickfall::cli
