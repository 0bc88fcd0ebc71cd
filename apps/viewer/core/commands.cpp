#include "viewer_core/commands.h"

#include <array>

namespace brickfall::viewer {

const char* nameOf(const Command& command) {
  // In the order of the variant.
  static constexpr std::array<const char*, std::variant_size_v<Command>> kNames = {
      "open",  "restart",   "run",    "pause",  "step",           "set the speed",  "rewind", "undo",
      "shoot", "take hold", "drag",   "let go", "remove",         "wake",           "blast",  "cut",
      "tilt",  "shake",     "select", "set",    "set a material", "save the state", "record", "stop recording"};
  return kNames[command.index()];
}

}  // namespace brickfall::viewer
