#include "viewer_core/opening.h"

#include <filesystem>

#include "brickfall/take.h"

namespace brickfall::viewer {

namespace {

// As docs/command-line.md has them.
constexpr int kBadInput = 2, kFileError = 3;
constexpr std::size_t kMostSceneBytes = 16u << 20, kMostStateBytes = 1u << 30;
constexpr std::string_view kTakeMagic =
    "\x89"
    "BFTAKE\n";
constexpr std::size_t kMagicBytes = 16;

bool looksLikePath(const std::string& text) { return text.find_first_of("/.") != std::string::npos; }

std::string absolute(const std::string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return error ? path : whole.lexically_normal().string();
}

void parse(OpenedFile& file, const std::string& shownAs) {
  SceneLoad load = parseScene(file.source.text, shownAs, file.source.overrides);
  file.opening.diagnostics = std::move(load.diagnostics);
  file.scene = std::move(load.scene);
  if (!file.scene) {
    file.opening.exitCode = kBadInput;
    return;
  }
  for (Diagnostic& warning : checkScene(*file.scene)) file.opening.diagnostics.push_back(std::move(warning));
}

void refuse(OpenedFile& file, const Error& error) {
  file.opening.exitCode = error.code == ErrorCode::inputOutput ? kFileError : kBadInput;
  file.opening.problem = error.message;
}

void readSaved(OpenedFile& file) {
  const std::string& path = file.opening.path;
  const Result<std::string> bytes = readFile(path, kMostStateBytes);
  if (!bytes) return refuse(file, bytes.error());
  Result<SavedState> state = readState(path, *bytes);
  if (!state) return refuse(file, state.error());
  file.source = std::move(state->source);
  file.snapshot = std::move(state->snapshot);
  parse(file, file.source.file);
}

}  // namespace

OpenedFile readOpening(const std::string& nameOrPath, const Overrides& overrides) {
  OpenedFile file;
  Opening& opening = file.opening;
  opening.path = findScene(nameOrPath);
  if (opening.path.empty() && !looksLikePath(nameOrPath)) {
    refuse(file, {ErrorCode::invalidArgument, unknownSceneMessage(nameOrPath, "a scene file, a take, a saved state")});
    return file;
  }
  if (opening.path.empty()) opening.path = nameOrPath;
  const Result<std::string> start = readStart(opening.path, kMagicBytes);
  if (!start) {
    refuse(file, start.error());
    return file;
  }
  if (start->starts_with(kTakeMagic) || isState(*start)) {
    opening.kind = isState(*start) ? OpeningKind::state : OpeningKind::take;
    if (!overrides.empty())
      refuse(file, {ErrorCode::invalidArgument, "--set: found with " + opening.path + ", expected with a scene file"});
    else if (opening.kind == OpeningKind::state)
      readSaved(file);
    return file;
  }
  Result<std::string> text = readFile(opening.path, kMostSceneBytes);
  if (!text) {
    refuse(file, text.error());
    return file;
  }
  file.source = {absolute(opening.path), std::move(*text), overrides};
  parse(file, opening.path);
  return file;
}

OpenedFile readAgain(const SceneSource& source) {
  OpenedFile file;
  file.opening.path = source.file;
  file.source = source;
  // As it is now, if it is still there.
  if (Result<std::string> text = readFile(source.file, kMostSceneBytes); text) file.source.text = std::move(*text);
  parse(file, source.file);
  return file;
}

Opening lookAtOpening(const std::string& nameOrPath, const Overrides& overrides) {
  OpenedFile file = readOpening(nameOrPath, overrides);
  if (file.opening.exitCode == 0 && file.opening.kind == OpeningKind::take)
    if (const Result<TakeReader> take = TakeReader::open(file.opening.path); !take) refuse(file, take.error());
  return std::move(file.opening);
}

}  // namespace brickfall::viewer
