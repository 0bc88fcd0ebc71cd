// brickfall check-dt: how far the outcomes of a scene agree from one time step to another.
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/outcome.h"
#include "cli/progress.h"
#include "cli/scene_choice.h"

namespace brickfall::cli {
namespace {

constexpr int kRates[] = {60, 120, 240, 480};

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::uint64_t stepsOf(const SceneDescription& scene, int rate) {
  return std::uint64_t(std::max(1L, std::lround(scene.seconds * rate)));
}

// How far all runs together are.
struct Progress {
  ProgressDisplay display;
  WorkState work;
  Clock::time_point begin = Clock::now();

  Progress(const SceneDescription& scene, bool quiet) : display(ProgressDisplay::modeForOutput(quiet)) {
    work.unit = "step";
    for (int rate : kRates) work.total += stepsOf(scene, rate);
  }
  void afterStep() {
    work.done++;
    work.wallSeconds = secondsSince(begin);
    display.updateWork(work);
  }
};

// None after a complaint, or when it was interrupted.
std::optional<Outcome> outcomeAt(SceneDescription scene, int rate, Progress& progress) {
  scene.timeStep = 1.0 / rate;
  scene.substeps = 1;
  Result<SceneRun> run = SceneRun::create(scene);
  if (!run) {
    complainf("1/{} s: {}", rate, run.error().message);
    return std::nullopt;
  }
  OutcomeWatch watch(*run);
  const Clock::time_point begin = Clock::now();
  const std::uint64_t steps = stepsOf(scene, rate);
  for (std::uint64_t step = 1; step <= steps; step++) {
    const Result<StepReport> report = run->step();
    if (!report) progress.display.finish();
    if (!report) complainf("1/{} s, step {}: {}", rate, step, report.error().message);
    if (!report || interruptCount() > 0) return std::nullopt;
    watch.afterStep(*run);
    progress.afterStep();
  }
  Outcome out = watch.outcomeOf(*run);
  out.seconds = secondsSince(begin);
  return out;
}

void tellAsTable(const SceneDescription& scene, const std::vector<Outcome>& outcomes) {
  const Outcome& finest = outcomes.back();
  sayf("{}: {} s of {} bodies that can move", printable(scene.name), scene.seconds, finest.ends.size());
  sayf("{:>9}  {:>6}  {:>16}  {:>14}  {:>6}  {:>16}  {:>9}", "time step", "moved", "same as 1/480 s", "ends apart, m",
       "broken", "same as 1/480 s", "took, s");
  for (std::size_t k = 0; k < outcomes.size(); k++) {
    const Outcome& out = outcomes[k];
    sayf("{:>9}  {:>6}  {:>14.1f} %  {:>14.3f}  {:>6}  {:>14.1f} %  {:>9.1f}", fmt::format("1/{} s", kRates[k]),
         out.moved.size(), 100 * overlapOf(out.moved, finest.moved), apartOf(out, finest), out.broken.size(),
         100 * overlapOf(out.broken, finest.broken), out.seconds);
  }
}

// The same, shares as 0 .. 1.
void tellAsJson(const SceneDescription& scene, const std::vector<Outcome>& outcomes) {
  const Outcome& finest = outcomes.back();
  auto runs = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < outcomes.size(); k++) {
    const Outcome& out = outcomes[k];
    runs.push_back({{"dt", 1.0 / kRates[k]},
                    {"moved", out.moved.size()},
                    {"moved_as_finest", overlapOf(out.moved, finest.moved)},
                    {"ends_apart", apartOf(out, finest)},
                    {"broken", out.broken.size()},
                    {"broken_as_finest", overlapOf(out.broken, finest.broken)},
                    {"took", out.seconds}});
  }
  const nlohmann::ordered_json answer = {
      {"scene", scene.name}, {"seconds", scene.seconds}, {"bodies", finest.ends.size()}, {"runs", runs}};
  say(answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace

int checkDt(const CheckDtCommand& options) {
  SceneChoice choice = chooseSceneToRun(options.scene, options.overrides, options.seconds, options.threads);
  if (!choice.scene) return choice.exitCode;
  watchInterrupts();
  Progress progress(*choice.scene, options.quiet || options.asJson);  // the answer is all that is on standard output
  std::vector<Outcome> outcomes;
  for (int rate : kRates) {
    std::optional<Outcome> outcome = outcomeAt(*choice.scene, rate, progress);
    if (!outcome) progress.display.finish();
    if (!outcome && interruptCount() > 0) complainf("interrupted at 1/{} s: there is nothing to compare", rate);
    if (!outcome) return interruptCount() > 0 ? interruptExitCode() : kInternalError;
    outcomes.push_back(std::move(*outcome));
  }
  progress.display.finish();
  if (options.asJson)
    tellAsJson(*choice.scene, outcomes);
  else
    tellAsTable(*choice.scene, outcomes);
  return kOk;
}

}  // namespace brickfall::cli
