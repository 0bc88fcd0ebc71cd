#include "render/source.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "brickfall/geometry/mesh_tree.h"
#include "brickfall/take_recorder.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "cli/scene_choice.h"

namespace brickfall::render {
namespace {

// FNV-1a, 64 bits.
std::uint64_t mixed(std::uint64_t hash, std::string_view bytes) {
  for (unsigned char c : bytes) hash = (hash ^ c) * 0x100000001b3ull;
  return hash;
}
constexpr std::uint64_t kNothingMixed = 0xcbf29ce484222325ull;

template <class Item> std::uint64_t mixed(std::uint64_t hash, const std::vector<Item>& items) {
  return mixed(hash, std::string_view(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)));
}

bool isTakeFile(const std::string& path) {
  if (path.ends_with(".take") || path.ends_with(".take.part")) return true;
  std::ifstream file(path, std::ios::binary);
  char start[8] = {};
  file.read(start, sizeof start);
  return isTake({start, std::size_t(file.gcount())});
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
  source.isScene = !isTakeFile(options.source);
  if (source.isScene) {
    cli::SceneChoice choice = cli::chooseScene(options.source, options.overrides);
    if (!choice.problem.empty()) cli::complain(choice.problem);
    cli::showDiagnostics(choice.diagnostics);
    if (!choice.scene) return {choice.exitCode, {}};
    source.path = choice.path;
    source.name = cli::safeFileName(choice.scene->name);
    for (const SceneBody& body : choice.scene->bodies)
      for (const ShapeDef& shape : body.def.shapes)
        if (shape.mesh) source.meshes.push_back(shape.mesh);
  } else {
    source.name = cli::safeFileName(std::filesystem::path(source.path).stem().string());
    if (options.seconds || !options.overrides.empty()) {
      cli::complainf("{}: found a take, expected a scene, since {} changes what is simulated", source.path,
                     options.seconds ? "--seconds" : "--set");
      return {cli::kBadInput, {}};
    }
  }
  return {cli::kOk, source};
}

Result<std::uint64_t> fingerprintOf(const Source& source, const RenderOptions& options) {
  std::uint64_t hash = kNothingMixed;
  std::ifstream file(source.path, std::ios::binary);
  std::vector<char> block(1 << 16);  // a take may be larger than memory
  while (file) {
    file.read(block.data(), std::streamsize(block.size()));
    hash = mixed(hash, std::string_view(block.data(), std::size_t(file.gcount())));
  }
  if (!file.eof())
    return Error{ErrorCode::inputOutput, fmt::format("cannot read '{}': {}", source.path, std::strerror(errno))};
  for (const auto& mesh : source.meshes) hash = mixed(mixed(hash, mesh->mesh().vertices()), mesh->mesh().faces());
  for (const auto& [key, value] : options.overrides) hash = mixed(hash, key + "=" + value + "\n");
  if (options.seconds) hash = mixed(hash, fmt::format("{}", *options.seconds));
  return hash;
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
  cli::SceneChoice choice = cli::chooseScene(source.path, options.overrides);
  if (!choice.scene) return failed(choice.exitCode);  // it was there a moment ago, and what is wrong has been said
  if (options.seconds) choice.scene->seconds = *options.seconds;
  choice.scene->world.threads = options.threads;
  Result<SceneRun> run = SceneRun::create(*choice.scene);
  if (!run) return cli::complainf("{}: {}", source.path, run.error().message), failed(cli::kBadInput);
  return simulate(*run, takePath, display);
}

}  // namespace brickfall::render
