// The list of outputs: a new one is a file of its own and a row here.
#include "brickfall/output.h"

namespace brickfall {

std::span<const OutputKind> outputKinds() {
  static constexpr OutputKind kKinds[] = {
      {"html", "replay.html", "to watch: opens in any browser", writeReplayHtml},
      {"glb", "*.glb", "for Blender and other tools", writeGlb},
  };
  return kKinds;
}

}  // namespace brickfall
