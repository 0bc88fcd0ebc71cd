// brickfall run: a scene is loaded, simulated and recorded; from the recording come the outputs.
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "brickfall/take_recorder.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/metrics.h"
#include "cli/outputs.h"
#include "cli/result_folder.h"
#include "cli/scene_choice.h"
#include "cli/series.h"
#include "cli/summary.h"

namespace brickfall::cli {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Simulated {
  int exitCode = kOk;
  double wallSeconds = 0;
};

// Until the end, an interrupt or an error. What was simulated until then is in the recording in every case.
Simulated simulate(SceneRun& run, std::uint64_t steps, RunMetrics& metrics, RunSeries& series, TakeRecorder& recorder,
                   ProgressDisplay& display) {
  Simulated result;
  const Clock::time_point start = Clock::now();
  ProgressState progress;
  progress.totalSeconds = double(steps) * run.scene().timeStep;
  for (std::uint64_t i = 0; i < steps && interruptCount() == 0; i++) {
    const Result<StepReport> report = run.step();
    if (!report) {
      display.finish();
      complainf("step {}: {}", i + 1, report.error().message);
      result.exitCode = kInternalError;
      break;
    }
    metrics.afterStep(run.world(), *report);
    series.afterStep(run, *report, metrics);
    if (const Status written = recorder.afterStep(run, *report); !written) {
      display.finish();
      complainf("{}; what was recorded is kept in '{}'", written.error().message, recorder.file());
      result.exitCode = kFileError;
      break;
    }
    progress.simulatedSeconds = report->time;
    progress.steps = i + 1;
    progress.wallSeconds = result.wallSeconds = secondsSince(start);
    display.update(progress);
    if (run.scene().stopAtRest && run.atRest()) break;
  }
  display.finish();
  return result;
}

Summary summaryOf(const SceneRun& run, const RunFigures& figures, double wallSeconds, const std::string& path) {
  const SceneDescription& scene = run.scene();
  return {scene.name,  scene.seed, run.world().stateHash(), scene.timeStep, scene.world.threads,
          wallSeconds, figures,    absolutePath(path)};
}

void sayResult(const Summary& summary) {
  const RunFigures& f = summary.figures;
  sayf("{}: {} {}, {} steps: {:g} s simulated in {}", summary.scene, f.bodies, f.bodies == 1 ? "body" : "bodies",
       f.steps, f.simulatedSeconds, durationText(summary.wallClockSeconds));
  if (f.bricks > 0) sayf("{} of {} bricks lie more than 50 mm from their place", f.bricksMoved50mm, f.bricks);
}

// From the finished recording to the files; says where they are.
int deliver(const std::string& takePath, const std::string& folder, const std::string& summaryJson,
            const std::string& seriesCsv, const OutputOptions& options, ProgressDisplay& display) {
  std::vector<WrittenFile> files;
  int exitCode = kOk;
  const Result<TakeReader> take = TakeReader::open(takePath);
  if (take) {
    OutputsResult written = writeOutputs(*take, folder, options, display);
    exitCode = written.exitCode;
    files = std::move(written.files);
  } else {
    complain(take.error().message);
    exitCode = kFileError;
  }
  if (!writeText(joinPath(folder, "summary.json"), summaryJson, "the figures (docs/summary.md)", files))
    exitCode = kFileError;
  if (!writeText(joinPath(folder, "series.csv"), seriesCsv, "the figures over time (docs/series.md)", files))
    exitCode = kFileError;
  files.push_back({takePath, "the recording, for brickfall replay"});
  if (!options.quiet) listFiles(files);
  return exitCode;
}

int firstProblem(std::initializer_list<int> exitCodes) {
  for (int code : exitCodes)
    if (code != kOk) return code;
  return kOk;
}

}  // namespace

int run(const RunOptions& options) {
  SceneChoice choice = chooseSceneToRun(options.scene, options.overrides, options.seconds, options.threads);
  if (!choice.scene) return choice.exitCode;

  const std::string name = safeFileName(choice.scene->name);
  const std::string folder = options.output.folder.empty() ? resultFolder(name, choice.path) : options.output.folder;
  if (const Status made = makeFolder(folder); !made) {
    complain(made.error().message);
    return kFileError;
  }
  Result<SceneRun> created = SceneRun::create(*choice.scene);
  if (!created) {
    complainf("{}: {}", choice.path, created.error().message);
    return kBadInput;
  }
  SceneRun& scene = *created;
  const std::string takePath = joinPath(folder, name + ".take");
  Result<TakeRecorder> recorder = TakeRecorder::create(takePath, scene);
  if (!recorder) {
    complain(recorder.error().message);
    return kFileError;
  }

  watchInterrupts();
  const double wanted = std::round(scene.scene().seconds / scene.scene().timeStep);
  const std::uint64_t steps = wanted < 1 ? 1 : std::uint64_t(wanted);
  RunMetrics metrics(scene.world(), scene.bodies(), steps);
  RunSeries series(scene, metrics);
  ProgressDisplay display(ProgressDisplay::modeForOutput(options.output.quiet));
  const Simulated simulated = simulate(scene, steps, metrics, series, *recorder, display);
  const int interrupted = interruptCount() > 0 ? interruptExitCode() : kOk;
  if (interrupted != kOk)
    complainf("interrupted after {:.2f} s of {:g} s: what was simulated is kept", scene.time(), scene.scene().seconds);

  const Summary summary = summaryOf(scene, metrics.finish(scene.world()), simulated.wallSeconds, choice.path);
  const std::string json = toJson(summary);
  int finished = kOk;
  if (const Status status = recorder->finish(toTakeJson(summary, series.columns()));
      !status && simulated.exitCode != kFileError) {
    complainf("{}; what was recorded is kept in '{}'", status.error().message, recorder->file());
    finished = kFileError;
  }
  if (!options.output.quiet) sayResult(summary);
  const int delivered = deliver(recorder->file(), folder, json, toCsv(series.columns()), options.output, display);
  if (summary.figures.quarantined > 0)
    complainf("bodies became non-finite or were lost (too fast, too far), and were taken out of the simulation: {}",
              summary.figures.quarantined);
  return firstProblem(
      {simulated.exitCode, interrupted, finished, delivered, summary.figures.quarantined > 0 ? kQuarantined : kOk});
}

}  // namespace brickfall::cli
