// What `brickfall run` does, in a page: a scene file is read, simulated and recorded, and the recording becomes a page that
// plays in any browser.
#include <cmath>
#include <cstdio>
#include <string>

#include "brickfall/output.h"
#include "brickfall/scene.h"
#include "brickfall/take_recorder.h"

using namespace brickfall;

namespace {

int failed(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return failed("usage: recorded_wall SCENE.toml FOLDER");
  const std::string takePath = std::string(argv[2]) + "/wall.take", pagePath = std::string(argv[2]) + "/wall.html";

  SceneLoad load = loadSceneFile(argv[1]);
  for (const Diagnostic& diagnostic : load.diagnostics) std::fprintf(stderr, "%s\n", format(diagnostic).c_str());
  if (!load.scene) return 2;
  Result<SceneRun> run = SceneRun::create(*load.scene);
  if (!run) return failed(run.error().message);
  Result<TakeRecorder> recorder = TakeRecorder::create(takePath, *run);
  if (!recorder) return failed(recorder.error().message);

  for (int i = 0; i < std::lround(1 / load.scene->timeStep); i++) {  // a second
    Result<StepReport> report = run->step();
    if (!report) return failed(report.error().message);
    if (Status written = recorder->afterStep(*run, *report); !written) return failed(written.error().message);
  }
  if (Status finished = recorder->finish(""); !finished) return failed(finished.error().message);

  Result<TakeReader> take = TakeReader::open(takePath);
  if (!take) return failed(take.error().message);
  if (Status page = writeReplayHtml(*take, pagePath); !page) return failed(page.error().message);
  std::printf("%zu frames in %s\n", take->frameCount(), pagePath.c_str());
  return 0;
}
