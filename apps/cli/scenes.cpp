// brickfall scenes: what is shipped.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "brickfall/scene.h"
#include "cli/commands.h"
#include "cli/console.h"

namespace brickfall::cli {

int listScenes(bool asJson) {
  const std::vector<ShippedScene> scenes = shippedScenes();
  if (scenes.empty()) {
    complain("no shipped scenes found: set BRICKFALL_SCENES to the folder that holds them");
    return kFileError;
  }
  if (asJson) {
    auto list = nlohmann::ordered_json::array();
    for (const ShippedScene& scene : scenes)
      list.push_back({{"name", scene.name}, {"title", scene.title}, {"file", scene.path}});
    say(list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return kOk;
  }
  std::size_t widest = 0;
  for (const ShippedScene& scene : scenes) widest = std::max(widest, scene.name.size());
  for (const ShippedScene& scene : scenes) sayf("{:<{}}  {}", scene.name, widest, scene.title);
  return kOk;
}

}  // namespace brickfall::cli
