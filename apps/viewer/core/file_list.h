// Files near at hand that can be opened: those opened last, and scenes, takes and saved states of the folder.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace brickfall::viewer {

enum class FileKind : std::uint8_t { recent, scene, take, state };
struct FileEntry {
  FileKind kind = FileKind::scene;
  std::string path;  // as it is shown and opened: relative to the folder where it lies in it
};

// The recent ones first, as they are given, then by kind and name. Looks a few folders deep, not into hidden ones.
std::vector<FileEntry> findFiles(const std::string& folder, const std::vector<std::string>& recent);
// Holds the typed words, in any order and case.
bool fits(const FileEntry& entry, std::string_view typed);

// Of all sessions of the user: in $XDG_STATE_HOME/brickfall, or ~/.local/state/brickfall. Newest first; those that are gone left out.
std::vector<std::string> recentFiles();
void rememberFile(const std::string& path);  // where it cannot be written nothing is remembered

}  // namespace brickfall::viewer
