// From what the user named to a scene that can be run, with a message for every way it can go wrong.
#pragma once
#include <optional>
#include <string>

#include "brickfall/scene.h"

namespace brickfall::cli {

struct SceneChoice {
  int exitCode = 0;     // of commands.h; not 0: why is in `problem` or was among the diagnostics
  std::string problem;  // why no file was read
  std::string path;
  std::vector<Diagnostic> diagnostics;
  std::optional<SceneDescription> scene;
};

// A scene file, or a shipped scene by its name, with overrides.
SceneChoice chooseScene(const std::string& nameOrPath, const Overrides& overrides);
// The same for a command that runs the scene, for so long and on so many threads: complains of whatever is wrong.
SceneChoice chooseSceneToRun(const std::string& nameOrPath, const Overrides& overrides, std::optional<double> seconds,
                             std::optional<int> threads);
// Each diagnostic as a line on standard error.
void showDiagnostics(const std::vector<Diagnostic>& diagnostics);

}  // namespace brickfall::cli
