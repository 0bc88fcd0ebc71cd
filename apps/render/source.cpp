#include "render/source.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "brickfall/take_recorder.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/scene_choice.h"

namespace brickfall::render {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// FNV-1a, 64 bits.
std::uint64_t mixed(std::uint64_t hash, std::string_view bytes) {
  for (unsigned char c : bytes) hash = (hash ^ c) * 0x100000001b3ull;
  return hash;
}

bool isTake(const std::string& path) {
  if (path.ends_with(".take") || path.ends_with(".take.part")) return true;
  std::ifstream file(path, std::ios::binary);
  char magic[7] = {};
  file.read(magic, 7);
  return file.gcount() == 7 && std::string_view(magic, 7) ==
                                   "\x89"
                                   "BFTAKE";
}

OpenedTake failed(int exitCode) { return {exitCode, nullptr}; }

// What was simulated until an error or an interrupt is of no use: half a film of it would be taken for the whole.
OpenedTake simulate(SceneRun& run, const std::string& takePath, cli::ProgressDisplay& display) {
  Result<TakeRecorder> recorder = TakeRecorder::create(takePath, run);
  if (!recorder) return cli::complain(recorder.error().message), failed(cli::kFileError);
  const auto steps = std::uint64_t(std::max(1.0, std::round(run.scene().seconds / run.scene().timeStep)));
  for (std::uint64_t i = 0; i < steps; i++) {
    if (cli::interruptCount() > 0)
      return display.finish(), cli::complain("interrupted while the scene was simulated: no picture was made"),
             failed(cli::interruptExitCode());
    const Result<StepReport> report = run.step();
    if (!report) return cli::complainf("step {}: {}", i + 1, report.error().message), failed(cli::kInternalError);
    if (const Status written = recorder->afterStep(run, *report); !written)
      return cli::complain(written.error().message), failed(cli::kFileError);
    display.update("simulating " + run.scene().name, double(i + 1) / double(steps));
  }
  if (const Status finished = recorder->finish(""); !finished)
    return cli::complain(finished.error().message), failed(cli::kFileError);
  display.finish();
  return openTake(takePath);
}

}  // namespace

SourceChoice chooseSource(const RenderOptions& options) {
  Source source;
  source.path = options.source;
  source.isScene = !isTake(options.source);
  if (source.isScene) {
    cli::SceneChoice choice = cli::chooseScene(options.source, options.overrides);
    if (!choice.problem.empty()) cli::complain(choice.problem);
    cli::showDiagnostics(choice.diagnostics);
    if (!choice.scene) return {choice.exitCode, {}};
    source.path = choice.path;
    source.name = cli::safeFileName(choice.scene->name);
  } else {
    source.name = cli::safeFileName(std::filesystem::path(source.path).stem().string());
    if (options.seconds || !options.overrides.empty()) {
      cli::complainf("{}: found a take, expected a scene, since {} changes what is simulated", source.path,
                     options.seconds ? "--seconds" : "--set");
      return {cli::kBadInput, {}};
    }
  }
  source.fingerprint = mixed(0xcbf29ce484222325ull, contentOf(source.path));
  for (const auto& [key, value] : options.overrides)
    source.fingerprint = mixed(source.fingerprint, key + "=" + value + "\n");
  if (options.seconds) source.fingerprint = mixed(source.fingerprint, fmt::format("{}", *options.seconds));
  return {cli::kOk, source};
}

OpenedTake openTake(const std::string& path) {
  Result<TakeReader> take = TakeReader::open(path);
  if (!take) return cli::complain(take.error().message), failed(cli::kFileError);
  if (take->frameCount() == 0)
    return cli::complainf("'{}': no whole frame was recorded, nothing can be made from it", path),
           failed(cli::kFileError);
  return {cli::kOk, std::make_unique<TakeReader>(std::move(take).value())};
}

OpenedTake runScene(const Source& source, const RenderOptions& options, const std::string& takePath,
                    cli::ProgressDisplay& display) {
  std::error_code ignored;
  if (std::filesystem::exists(takePath, ignored)) return openTake(takePath);
  cli::SceneChoice choice = cli::chooseScene(source.path, options.overrides);
  if (!choice.scene) return failed(choice.exitCode);  // it was there a moment ago, and what is wrong has been said
  if (options.seconds) choice.scene->seconds = *options.seconds;
  choice.scene->world.threads = options.threads;
  Result<SceneRun> run = SceneRun::create(*choice.scene);
  if (!run) return cli::complainf("{}: {}", source.path, run.error().message), failed(cli::kBadInput);
  return simulate(*run, takePath, display);
}

}  // namespace brickfall::render
