// brickfall check: every mistake of scene files, without running them.
#include <algorithm>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/scene_choice.h"

namespace brickfall::cli {

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
    if (warnings == 0)
      sayf("{}: fine", choice.path);
    else
      sayf("{}: can be run, {} warning{}", choice.path, warnings, warnings == 1 ? "" : "s");
  }
  return exitCode;
}

}  // namespace brickfall::cli
