// What a name or path is, and reading it: a scene file, a take or a saved state.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "brickfall/take.h"
#include "viewer_core/state_file.h"

namespace brickfall::viewer {

enum class OpeningKind : std::uint8_t { scene, take, state };
struct Opening {
  int exitCode = 0;  // of docs/command-line.md: 0, 2 bad input, 3 the file can't be read
  OpeningKind kind = OpeningKind::scene;
  std::string path;
  std::string problem;  // one line; empty: none, or it is in the diagnostics
  std::vector<Diagnostic> diagnostics;
};

struct OpenedFile {
  Opening opening;
  SceneSource source;                     // of a scene or a state
  SavedSettings settings;                 // of a state
  std::optional<SceneDescription> scene;  // with its settings; none: a take, or there is a mistake
  std::vector<std::byte> snapshot;        // of a state
  std::optional<TakeReader> take;         // of a take
};

// Before a window opens, so that a mistake is told at the command line; or when something else is opened in it.
OpenedFile readOpening(const std::string& nameOrPath, const Overrides& overrides);
// A scene from a text that was read before.
OpenedFile readAgain(const SceneSource& source);

}  // namespace brickfall::viewer
