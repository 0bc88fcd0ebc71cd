// brickfall trace: writes down what every stage of a run did, as hashes, and finds where two such runs part.
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "brickfall/whole_file.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/scene_choice.h"
#include "cli/trace_file.h"

namespace brickfall::cli {
namespace {

std::string nameOfBody(const SceneRun& run, BodyId id) {
  const PlacedBody* body = run.find(id);
  return body && !body->name.empty() ? printable(body->name) : fmt::format("body {}", id.index);
}

void append(const StepReport& report, std::uint64_t step, const SceneRun& run, Trace& trace) {
  for (const StageHash& hash : report.stageHashes) {
    TraceStage stage{step, hash.substep, std::string(nameOf(hash)), hash.hash, {}};
    for (const ItemHash& item : hash.items) {
      std::string name = nameOfBody(run, item.bodyA);
      if (item.bodyB) name += " | " + nameOfBody(run, item.bodyB);
      stage.items.push_back({std::move(name), item.hash});
    }
    trace.stages.push_back(std::move(stage));
  }
}

Result<Trace> readTrace(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || file.bad())
    return Error{ErrorCode::inputOutput, fmt::format("cannot read trace '{}': {}", path, std::strerror(errno))};
  return parseTrace(std::move(text).str(), path);
}

}  // namespace

int trace(const TraceCommand& options) {
  SceneChoice choice = chooseSceneToRun(options.scene, options.overrides, options.seconds, options.threads);
  if (!choice.scene) return choice.exitCode;
  Result<SceneRun> created = SceneRun::create(*choice.scene);
  if (!created) {
    complainf("{}: {}", choice.path, created.error().message);
    return kBadInput;
  }
  SceneRun& run = *created;
  const SceneDescription& scene = run.scene();
  const std::string name = safeFileName(scene.name);
  const std::string path = options.output.empty() ? joinPath(joinPath("out", name), name + ".trace") : options.output;
  const std::size_t slash = path.rfind('/');
  if (slash != std::string::npos && slash > 0) {
    if (const Status made = makeFolder(path.substr(0, slash)); !made) {
      complain(made.error().message);
      return kFileError;
    }
  }

  watchInterrupts();
  Trace out{printable(scene.name), scene.seed, scene.timeStep, {}};
  const std::uint64_t steps = std::uint64_t(std::max(1.0, std::round(scene.seconds / scene.timeStep)));
  int exitCode = kOk;
  for (std::uint64_t step = 1; step <= steps && interruptCount() == 0; step++) {
    run.world().trace({true, options.itemsOfStep == step, false});
    const Result<StepReport> report = run.step();
    if (!report) {
      complainf("step {}: {}", step, report.error().message);
      exitCode = kInternalError;
      break;
    }
    append(*report, step, run, out);
  }
  out.complete = exitCode == kOk && interruptCount() == 0;
  if (const Status written = writeWhole(path, toText(out)); !written) {
    complain(written.error().message);
    return kFileError;
  }
  if (!options.quiet)
    sayf("{}: {} steps, state {:016x}: {}", out.scene, run.stepCount(), run.world().stateHash(), path);
  return interruptCount() > 0 ? interruptExitCode() : exitCode;
}

int compareTraces(const std::string& pathA, const std::string& pathB) {
  const Result<Trace> a = readTrace(pathA), b = readTrace(pathB);
  for (const auto* trace : {&a, &b})
    if (!*trace) {
      complain(trace->error().message);
      return trace->error().code == ErrorCode::inputOutput ? kFileError : kBadInput;
    }
  if (a->scene != b->scene || a->timeStep != b->timeStep) {
    complainf("'{}' is of {} at {} s a step, '{}' of {} at {} s: only traces of one scene can be compared", pathA,
              a->scene, a->timeStep, pathB, b->scene, b->timeStep);
    return kBadInput;
  }
  const std::optional<Parting> parting = firstParting(*a, *b);
  if (!parting) {
    sayf("the same in all {} steps", a->stages.empty() ? 0 : a->stages.back().step);
    return kOk;
  }
  const std::string place = fmt::format("step {} ({:.6g} s), substep {}, stage {}", parting->step,
                                        double(parting->step) * a->timeStep, parting->substep, parting->stage);
  if (parting->ended) {
    sayf("one trace ends before {}; until there both are the same", place);
  } else {
    sayf("the runs part in {}", place);
    if (parting->stage == "given") say("given: what the step starts from was changed between the steps, by calls");
    if (!parting->item.empty())
      sayf("first to differ: {}", parting->item);
    else if (!parting->hasItems)
      sayf("which body or contact: trace both runs again with --items {}", parting->step);
  }
  return kParted;
}

}  // namespace brickfall::cli
