// brickfall check: every mistake of scene files, without running them.
#include <algorithm>

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
    const std::string content = contentWords(*choice.scene);
    if (warnings == 0)
      sayf("{}: fine{}", choice.path, content);
    else
      sayf("{}: can be run, {} warning{}{}", choice.path, warnings, warnings == 1 ? "" : "s", content);
  }
  return exitCode;
}

}  // namespace brickfall::cli
