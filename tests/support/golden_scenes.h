// The shipped scenes as a yardstick: the state hash after some steps, and the step in which an island first fell asleep.
#pragma once
#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <string>

#include "brickfall/scene.h"

namespace brickfall::test {

struct Golden {
  std::string scene;
  int steps = 0;
  std::uint64_t hash = 0;
  int firstSleep = 0;  // step, from 1; 0: nothing fell asleep
  std::string problem;
};

// A scene's name as a test may have it.
inline std::string testNameOf(std::string scene) {
  std::replace(scene.begin(), scene.end(), '-', '_');
  return scene;
}

inline std::string toLine(const Golden& g) {
  char text[200];
  std::snprintf(text, sizeof text, "%-16s %4d  %016" PRIx64 "  %d", g.scene.c_str(), g.steps, g.hash, g.firstSleep);
  return text;
}

// 2.5 s, or less where there are so many bodies that this would take long.
inline int goldenSteps(const SceneRun& run) {
  const int whole = int(std::lround(2.5 / run.scene().timeStep));
  return std::clamp(100'000 / std::max(1, int(run.bodies().size())), std::min(20, whole), whole);
}

// steps 0: as many as goldenSteps says.
inline Golden runGolden(const std::string& scene, int steps = 0, int threads = 1) {
  Golden out;
  out.scene = scene;
  SceneLoad load = loadSceneFile(findScene(scene));
  if (!load.scene) {
    out.problem = load.diagnostics.empty() ? "no such scene" : format(load.diagnostics.front());
    return out;
  }
  load.scene->world.threads = threads;
  Result<SceneRun> run = SceneRun::create(*load.scene);
  if (!run) {
    out.problem = run.error().message;
    return out;
  }
  out.steps = steps > 0 ? steps : goldenSteps(*run);
  for (int i = 1; i <= out.steps; i++) {
    Result<StepReport> report = run->step();
    if (!report) {
      out.problem = report.error().message;
      return out;
    }
    if (out.firstSleep == 0 && !run->world().events().fellAsleep.empty()) out.firstSleep = i;
  }
  out.hash = run->world().stateHash();
  return out;
}

}  // namespace brickfall::test
