#include "cli/files.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace brickfall::cli {
namespace fs = std::filesystem;
namespace {

Error fileError(std::string_view what, const std::string& path, std::string_view why) {
  return {ErrorCode::inputOutput, fmt::format("cannot {} '{}': {}", what, path, why)};
}

}  // namespace

Status makeFolder(const std::string& folder) {
  std::error_code error;
  const fs::path path(folder);
  fs::create_directories(path, error);
  for (fs::path part = path; !part.empty(); part = part.parent_path()) {
    std::error_code ignored;
    if (fs::exists(part, ignored) && !fs::is_directory(part, ignored))
      return fileError("make folder", folder, fmt::format("'{}' is a file", part.string()));
    if (part == part.parent_path()) break;
  }
  if (error) return fileError("make folder", folder, error.message());
  if (access(folder.c_str(), W_OK | X_OK) != 0) return fileError("write into", folder, std::strerror(errno));
  return {};
}

std::string joinPath(const std::string& folder, const std::string& name) {
  return folder.empty() ? name : (fs::path(folder) / name).string();
}

std::string safeFileName(const std::string& name) {
  if (name.empty() || name[0] == '.' || name.size() > 100) return "scene";
  for (unsigned char c : name)
    if (c >= 0x80 || (!std::isalnum(c) && c != '-' && c != '_' && c != '.')) return "scene";
  return name;
}

std::string sizeText(const std::string& path) {
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  if (error) return "";
  if (bytes < 1'000'000) return fmt::format("{:.0f} kB", double(bytes) / 1e3);
  return fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

}  // namespace brickfall::cli
