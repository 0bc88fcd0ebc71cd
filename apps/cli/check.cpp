// brickfall check: every mistake of scene files, without running them.
#include <algorithm>
#include <nlohmann/json.hpp>

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

nlohmann::ordered_json jsonOf(const std::string& name, const SceneChoice& choice) {
  nlohmann::ordered_json out = {{"scene", name}, {"file", choice.path}, {"ok", choice.scene.has_value()}};
  if (!choice.problem.empty()) out["problem"] = choice.problem;
  out["diagnostics"] = nlohmann::ordered_json::array();
  for (const Diagnostic& d : choice.diagnostics)
    out["diagnostics"].push_back({{"severity", d.severity == Severity::error ? "error" : "warning"},
                                  {"file", d.file},
                                  {"line", d.line},
                                  {"column", d.column},
                                  {"key", d.key},
                                  {"message", d.message}});
  return out;
}

}  // namespace

int check(const std::vector<std::string>& scenes, bool asJson) {
  int exitCode = kOk;
  auto answers = nlohmann::ordered_json::array();
  for (const std::string& name : scenes) {
    SceneChoice choice = chooseScene(name, {});
    if (!choice.problem.empty() && !asJson) complain(choice.problem);
    if (choice.scene) {
      std::vector<Diagnostic> more = checkScene(*choice.scene);
      for (Diagnostic& diagnostic : more)
        if (diagnostic.file.empty()) diagnostic.file = choice.path;
      choice.diagnostics.insert(choice.diagnostics.end(), more.begin(), more.end());
    }
    exitCode = std::max(exitCode, choice.exitCode);
    if (asJson) {
      answers.push_back(jsonOf(name, choice));
      continue;
    }
    showDiagnostics(choice.diagnostics);
    if (!choice.scene) continue;
    const auto isWarning = [](const Diagnostic& d) { return d.severity == Severity::warning; };
    const auto warnings = std::count_if(choice.diagnostics.begin(), choice.diagnostics.end(), isWarning);
    const std::string mortar = mortarWords(*choice.scene);
    if (warnings == 0)
      sayf("{}: fine{}", choice.path, mortar);
    else
      sayf("{}: can be run, {} warning{}{}", choice.path, warnings, warnings == 1 ? "" : "s", mortar);
  }
  if (asJson) say(answers.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  return exitCode;
}

}  // namespace brickfall::cli
