#include "render/frame_store.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "brickfall/whole_file.h"
#include "cli/files.h"

namespace brickfall::render {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSettingsFile = "settings.txt";
constexpr std::string_view kFrameStart = "frame_", kFrameEnd = ".png";

bool isFrameName(std::string_view name) {
  if (!name.starts_with(kFrameStart) || !name.ends_with(kFrameEnd)) return false;
  name.remove_prefix(kFrameStart.size());
  name.remove_suffix(std::min(kFrameEnd.size(), name.size()));
  return !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::string settingsDifference(const std::string& found, const std::string& expected) {
  std::istringstream a(found), b(expected);
  for (std::string lineA, lineB;;) {
    const bool moreA = bool(std::getline(a, lineA)), moreB = bool(std::getline(b, lineB));
    if (!moreA && !moreB) return {};
    if (moreA != moreB || lineA != lineB)
      return fmt::format("found {}, expected {}", moreA ? lineA : "nothing more", moreB ? lineB : "nothing more");
  }
}

Result<FrameStore> FrameStore::open(const std::string& folder, const std::string& settings) {
  FrameStore store(folder);
  std::error_code ignored;
  const bool wasThere = fs::exists(folder, ignored);
  if (const Status made = cli::makeFolder(folder); !made) return made.error();
  const std::string path = cli::joinPath(folder, kSettingsFile);
  store.goesOn_ = fs::exists(path, ignored);
  store.folderIsOurs_ = !wasThere || store.goesOn_;
  if (store.goesOn_) {
    std::ifstream file(path, std::ios::binary);
    const std::string found{std::istreambuf_iterator<char>(file), {}};
    if (const std::string difference = settingsDifference(found, settings); !difference.empty())
      return Error{
          ErrorCode::invalidArgument,
          fmt::format("'{}': pictures of other settings lie there ({}); give the same settings to go on with them, or "
                      "remove the folder",
                      folder, difference)};
    return store;
  }
  if (store.hasAny())
    return Error{ErrorCode::invalidArgument,
                 fmt::format("'{}': pictures lie there already, expected a folder without any", folder)};
  if (const Status written = writeWhole(path, settings); !written) return written.error();
  return store;
}

std::string FrameStore::frame(std::size_t index) const {
  return cli::joinPath(folder_, fmt::format("{}{:05}{}", kFrameStart, index, kFrameEnd));
}

std::string FrameStore::sceneTake() const { return cli::joinPath(folder_, ".brickfall-render.take"); }

bool FrameStore::hasAny() const {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder_, ignored), end; !ignored && entry != end; entry.increment(ignored))
    if (isFrameName(entry->path().filename().string())) return true;
  return false;
}

bool FrameStore::has(std::size_t index) const {
  std::error_code ignored;
  return fs::exists(frame(index), ignored);
}

void FrameStore::remove(std::size_t frames) const {
  std::error_code ignored;
  for (std::size_t k = 0; k < frames; k++) fs::remove(frame(k), ignored);
  forgetSettings();
  if (folderIsOurs_) fs::remove(folder_, ignored);  // only if it is empty
}

void FrameStore::forgetSettings() const {
  std::error_code ignored;
  fs::remove(cli::joinPath(folder_, kSettingsFile), ignored);
}

}  // namespace brickfall::render
