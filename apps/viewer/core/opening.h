// What a name or path is, and reading it: a scene file, a take or a saved state.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "viewer_core/scene_menu.h"
#include "viewer_core/state_file.h"

namespace brickfall::viewer {

struct OpenedFile {
  Opening opening;
  SceneSource source;                     // of a scene or a state
  std::optional<SceneDescription> scene;  // with its settings; none: a take, or there is a mistake
  std::vector<std::byte> snapshot;        // of a state
};

// A take is only looked at, not read: TakePlayer does.
OpenedFile readOpening(const std::string& nameOrPath, const Overrides& overrides);
// A scene from a text that was read before.
OpenedFile readAgain(const SceneSource& source);

}  // namespace brickfall::viewer
