#include "viewer_core/scene_menu.h"

#include <algorithm>

namespace brickfall::viewer {

namespace {

struct Named {
  const char* scene;
  const char* label;
};

// As the report names them.
constexpr Named kReport[] = {
    {"cube", "First test: a cube falls to the ground"},
    {"wall", "Core test: a wall of 100 bricks, and a body thrown in"},
    {"wall_stand", "Core test without the throw: the wall stands"},
    {"report_wall", "Core test under the report's own system: the wall falls by itself"},
};

}  // namespace

std::vector<MenuGroup> sceneMenu() {
  const std::vector<ShippedScene> shipped = shippedScenes();
  MenuGroup report{"The report's tests", {}}, all{"Scenes", {}};
  for (const Named& named : kReport)
    for (const ShippedScene& scene : shipped)
      if (scene.name == named.scene) report.entries.push_back({named.label, scene.name, scene.title});
  for (const ShippedScene& scene : shipped)
    all.entries.push_back({scene.title.empty() ? scene.name : scene.title, scene.name, scene.name});
  return {report, all};
}

}  // namespace brickfall::viewer
