#include "viewer_core/scene_menu.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace brickfall::viewer {

namespace {

struct Kind {
  const char* label;
  std::initializer_list<std::string_view> scenes;
};

// Each scene once; one that stands nowhere here is listed last.
const Kind kKinds[] = {
    {"The report's tests", {"cube", "wall", "wall_stand", "report_wall"}},
    {"Walls", {"hole", "wall_hit", "wall_stand_tall", "pendulum-wall", "hill", "garden-gate", "blast", "tilt-table"}},
    {"Mortar",
     {"mortar-wall", "wall-hits", "mortar-strength", "garden-wall", "house-hit", "arch-load", "column-crush"}},
    {"Houses, arches, domes",
     {"house", "roof", "wrecking-ball", "shake-table", "tower", "round-tower", "arch", "dome", "column", "bridge"}},
    {"Toys and trials", {"dominoes", "domino-spiral", "cradle", "pyramid", "mass_ratio", "pile"}},
};

}  // namespace

std::vector<MenuGroup> sceneMenu() {
  std::vector<ShippedScene> left = shippedScenes();
  std::vector<MenuGroup> menu;
  const auto add = [](MenuGroup& group, const ShippedScene& scene) {
    group.entries.push_back({scene.title.empty() ? scene.name : scene.title, scene.name, scene.name});
  };
  for (const Kind& kind : kKinds) {
    MenuGroup group{kind.label, {}};
    for (const std::string_view name : kind.scenes) {
      const auto scene = std::find_if(left.begin(), left.end(), [&](const ShippedScene& s) { return s.name == name; });
      if (scene == left.end()) continue;
      add(group, *scene);
      left.erase(scene);
    }
    menu.push_back(std::move(group));
  }
  MenuGroup others{"More", {}};
  for (const ShippedScene& scene : left) add(others, scene);
  menu.push_back(std::move(others));
  std::erase_if(menu, [](const MenuGroup& group) { return group.entries.empty(); });
  return menu;
}

}  // namespace brickfall::viewer
