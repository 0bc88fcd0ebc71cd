// The shipped scenes by kind, each once; the report's tests first.
#pragma once
#include <string>
#include <vector>

#include "brickfall/scene.h"

namespace brickfall::viewer {

struct MenuEntry {
  std::string label;  // as the menu shows it
  std::string scene;  // for Open
  std::string hint;   // its name
};
struct MenuGroup {
  std::string label;
  std::vector<MenuEntry> entries;
};
// Reads the shipped files: some tens of milliseconds, once. Entries of scenes that are not there are left out.
std::vector<MenuGroup> sceneMenu();

}  // namespace brickfall::viewer
