// brickfall check: every mistake of scene files, without running them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/scene_choice.h"

namespace brickfall::cli {

namespace {

std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

// ", 105 bricks (10 cut), 540 mortar joints"; nothing of a scene without.
std::string contentWords(const SceneDescription& scene) {
  const Result<SceneRun> run = SceneRun::create(scene);
  if (!run) return {};
  std::size_t bricks = 0, cut = 0;
  for (const PlacedBody& body : run->bodies()) bricks += body.role == BodyRole::brick;
  for (const SceneWall& wall : scene.walls)
    if (const Result<std::vector<BrickPlacement>> laid = layBricks(wall.wall, scene.seed))
      for (const BrickPlacement& brick : *laid) cut += brick.cut;
  std::string words = bricks > 0 ? ", " + counted(bricks, "brick") : std::string();
  if (cut > 0) words += fmt::format(" ({} cut)", cut);
  if (!run->mortars().empty()) words += ", " + counted(run->mortars().size(), "mortar joint");
  return words;
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

int check(const std::vector<std::string>& scenes, const Overrides& overrides, bool asJson) {
  int exitCode = kOk;
  auto answers = nlohmann::ordered_json::array();
  for (const std::string& name : scenes) {
    SceneChoice choice = chooseScene(name, overrides);
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
    const std::string content = contentWords(*choice.scene);
    if (warnings == 0)
      sayf("{}: fine{}", choice.path, content);
    else
      sayf("{}: can be run, {} warning{}{}", choice.path, warnings, warnings == 1 ? "" : "s", content);
  }
  if (asJson) say(answers.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  return exitCode;
}

}  // namespace brickfall::cli
