// brickfall check: every mistake of scene files, without running them.
#include <algorithm>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/scene_choice.h"

namespace brickfall::cli {

namespace {

// ", 540 mortar joints"; nothing of a dry scene.
std::string mortarWords(const SceneDescription& scene) {
  const bool any = !scene.mortars.empty() || std::any_of(scene.walls.begin(), scene.walls.end(),
                                                         [](const SceneWall& wall) { return wall.mortar.has_value(); });
  if (!any) return {};
  const Result<SceneRun> run = SceneRun::create(scene);
  if (!run) return {};
  const std::size_t count = run->mortars().size();
  return fmt::format(", {} mortar joint{}", count, count == 1 ? "" : "s");
}

}  // namespace

int check(const std::vector<std::string>& scenes) {
  int exitCode = kOk;
  for (const std::string& name : scenes) {
    SceneChoice choice = chooseScene(name, {});
    if (!choice.problem.empty()) complain(choice.problem);
    if (choice.scene) {
      std::vector<Diagnostic> more = checkScene(*choice.scene);
      for (Diagnostic& diagnostic : more)
        if (diagnostic.file.empty()) diagnostic.file = choice.path;
      choice.diagnostics.insert(choice.diagnostics.end(), more.begin(), more.end());
    }
    showDiagnostics(choice.diagnostics);
    exitCode = std::max(exitCode, choice.exitCode);
    if (!choice.scene) continue;
    const auto isWarning = [](const Diagnostic& d) { return d.severity == Severity::warning; };
    const auto warnings = std::count_if(choice.diagnostics.begin(), choice.diagnostics.end(), isWarning);
    const std::string mortar = mortarWords(*choice.scene);
    if (warnings == 0)
      sayf("{}: fine{}", choice.path, mortar);
    else
      sayf("{}: can be run, {} warning{}{}", choice.path, warnings, warnings == 1 ? "" : "s", mortar);
  }
  return exitCode;
}

}  // namespace brickfall::cli
