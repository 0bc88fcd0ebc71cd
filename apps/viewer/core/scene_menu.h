// What can be opened: the report's two tests, then all that is shipped; and what a name or path is, before a window opens.
#pragma once
#include <string>
#include <vector>

#include "brickfall/scene.h"

namespace brickfall::viewer {

struct MenuEntry {
  std::string label;  // as the menu shows it
  std::string scene;  // for Open
  std::string hint;   // the scene's title
};
struct MenuGroup {
  std::string label;
  std::vector<MenuEntry> entries;
};
// Reads the shipped files: some tens of milliseconds, once. Entries of scenes that are not there are left out.
std::vector<MenuGroup> sceneMenu();

enum class OpeningKind : std::uint8_t { scene, take, state };
// What a user named at the command line, so that a mistake is told there and not in a window.
struct Opening {
  int exitCode = 0;  // of docs/command-line.md: 0, 2 bad input, 3 the file can't be read
  OpeningKind kind = OpeningKind::scene;
  std::string path;
  std::string problem;  // one line; empty: none, or it is in the diagnostics
  std::vector<Diagnostic> diagnostics;
};
Opening lookAtOpening(const std::string& nameOrPath, const Overrides& overrides);

}  // namespace brickfall::viewer
