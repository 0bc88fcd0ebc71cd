// brickfall scenes: what is shipped.
#include <algorithm>

#include "brickfall/scene.h"
#include "cli/commands.h"
#include "cli/console.h"

namespace brickfall::cli {

int listScenes() {
  const std::vector<ShippedScene> scenes = shippedScenes();
  if (scenes.empty()) {
    complain("no shipped scenes found: set BRICKFALL_SCENES to the folder that holds them");
    return kFileError;
  }
  std::size_t widest = 0;
  for (const ShippedScene& scene : scenes) widest = std::max(widest, scene.name.size());
  for (const ShippedScene& scene : scenes) sayf("{:<{}}  {}", scene.name, widest, scene.title);
  return kOk;
}

}  // namespace brickfall::cli
