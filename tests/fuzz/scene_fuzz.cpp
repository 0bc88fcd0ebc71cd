// libFuzzer: any text as a scene file. It is a scene or has reasons why not, each with a place in the file; a scene that
// asks for little is built, looked over and stepped.
#include <algorithm>

#include "brickfall/scene.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace brickfall;
using fuzz::require;

constexpr std::int64_t kMostBodies = 40;
constexpr int kSteps = 3;

void checkDiagnostics(const SceneLoad& load, std::string_view text) {
  bool error = false;
  int lines = 1 + int(std::count(text.begin(), text.end(), '\n'));
  for (const Diagnostic& d : load.diagnostics) {
    error = error || d.severity == Severity::error;
    require(!d.message.empty() && d.file == "fuzz.toml", "a diagnostic that says nothing");
    require(d.line >= 0 && d.line <= lines + 1 && d.column >= 0, "a diagnostic outside the file: " + format(d));
  }
  require(load.scene.has_value() != error, "neither a scene nor an error, or both");
}

bool isSmall(const SceneDescription& scene) {
  std::int64_t bodies = std::int64_t(scene.bodies.size());
  std::size_t openings = 0;
  for (const SceneWall& wall : scene.walls) {
    bodies += brickCount(wall.wall) + std::int64_t(wall.wall.piers.size());
    openings += wall.wall.openings.size();
  }
  return bodies <= kMostBodies && openings <= 20 && scene.substeps <= 4;
}

void runScene(const SceneDescription& scene) {
  for (const Diagnostic& d : checkScene(scene))
    require(d.severity == Severity::warning, "a sound file can't be built: " + format(d));
  Result<SceneRun> run = SceneRun::create(scene);
  require(run.ok(), "a sound file can't be built: " + run.error().message);
  for (int i = 0; i < kSteps; i++) {
    Result<StepReport> report = run->step();
    require(report.ok(), "a step is refused: " + report.error().message);
    for (const std::string& wrong : run->world().validate()) require(false, wrong);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  SceneLoad load = parseScene(text, "fuzz.toml");
  checkDiagnostics(load, text);
  if (load.scene && isSmall(*load.scene)) runScene(*load.scene);
  return 0;
}
