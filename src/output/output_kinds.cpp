// The list of outputs: a new one is a file of its own and a row here.
#include "brickfall/output.h"

namespace brickfall {

namespace {

Status writePlainPage(const TakeReader& take, const std::string& path, const Progress& progress) {
  return writeReplayHtml(take, path, progress);
}

}  // namespace

std::span<const OutputKind> outputKinds() {
  static constexpr OutputKind kKinds[] = {
      {"html", "replay.html", "to watch: opens in any browser", writePlainPage},
      {"glb", "*.glb", "for Blender and other tools", writeGlb},
  };
  return kKinds;
}

}  // namespace brickfall
