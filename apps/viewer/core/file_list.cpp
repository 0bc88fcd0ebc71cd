#include "viewer_core/file_list.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "brickfall/whole_file.h"

namespace brickfall::viewer {

namespace {

namespace fs = std::filesystem;

constexpr int kDepth = 3;  // folders below the one that is looked at
constexpr std::size_t kMostFiles = 400, kMostLooked = 20000, kMostRecent = 12;

// Of no other ending.
bool kindOfFile(const fs::path& path, FileKind& kind) {
  const std::string ending = path.extension().string();
  if (ending == ".toml") kind = FileKind::scene;
  if (ending == ".take") kind = FileKind::take;
  if (ending == ".state") kind = FileKind::state;
  return ending == ".toml" || ending == ".take" || ending == ".state";
}

fs::path recentList() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state && *state) return fs::path(state) / "brickfall" / "recent";
  const char* home = std::getenv("HOME");
  if (!home || !*home) return {};
  return fs::path(home) / ".local" / "state" / "brickfall" / "recent";
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return out;
}

}  // namespace

std::vector<FileEntry> findFiles(const std::string& folder, const std::vector<std::string>& recent) {
  std::vector<FileEntry> found;
  std::error_code problem;
  constexpr auto kOptions = fs::directory_options::skip_permission_denied;
  std::size_t looked = 0;
  for (fs::recursive_directory_iterator at(folder, kOptions, problem), end; !problem && at != end;
       at.increment(problem)) {
    if (++looked > kMostLooked || found.size() >= kMostFiles) break;
    const std::string name = at->path().filename().string();
    std::error_code unknown;
    if (at->is_directory(unknown)) {
      if (name.starts_with(".") || name == "node_modules" || at.depth() >= kDepth) at.disable_recursion_pending();
      continue;
    }
    FileEntry entry;
    if (!kindOfFile(at->path(), entry.kind) || !at->is_regular_file(unknown)) continue;
    entry.path = at->path().lexically_normal().string();
    found.push_back(std::move(entry));
  }
  std::sort(found.begin(), found.end(), [](const FileEntry& a, const FileEntry& b) {
    const auto deep = [](const FileEntry& e) { return std::count(e.path.begin(), e.path.end(), '/'); };
    return std::tuple(a.kind, deep(a), a.path) < std::tuple(b.kind, deep(b), b.path);
  });
  std::vector<FileEntry> all;
  for (const std::string& path : recent) all.push_back({FileKind::recent, path});
  all.insert(all.end(), found.begin(), found.end());
  return all;
}

bool fits(const FileEntry& entry, std::string_view typed) {
  const std::string path = lower(entry.path), words = lower(typed);
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    if (path.find(words.substr(at, end - at)) == std::string::npos) return false;
    at = end + 1;
  }
  return true;
}

std::vector<std::string> recentFiles() {
  std::vector<std::string> files;
  std::ifstream in(recentList());
  std::error_code problem;
  for (std::string line; files.size() < kMostRecent && std::getline(in, line);)
    if (!line.empty() && fs::is_regular_file(line, problem)) files.push_back(line);
  return files;
}

void rememberFile(const std::string& path) {
  const fs::path list = recentList();
  std::error_code problem;
  if (list.empty() || path.empty() || path.find('\n') != std::string::npos) return;
  const std::string whole = fs::absolute(path, problem).lexically_normal().string();
  if (problem || !fs::is_regular_file(whole, problem)) return;
  std::string text = whole + "\n";
  for (const std::string& old : recentFiles())
    if (old != whole) text += old + "\n";
  fs::create_directories(list.parent_path(), problem);
  if (!problem) (void)writeWhole(list.string(), text).ok();
}

}  // namespace brickfall::viewer
