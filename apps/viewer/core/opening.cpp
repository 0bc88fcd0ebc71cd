#include "viewer_core/opening.h"

#include <filesystem>

#include "viewer_core/event_log.h"
#include "viewer_core/settings_table.h"

namespace brickfall::viewer {

namespace {

// As docs/command-line.md has them.
constexpr int kBadInput = 2, kFileError = 3;
constexpr std::size_t kMostSceneBytes = 16u << 20, kMostStateBytes = 1u << 30;
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

void readSaved(OpenedFile& file, InputFile& input) {
  const std::string& path = file.opening.path;
  if (const Status read = input.readAll(kMostStateBytes); !read) return refuse(file, read.error());
  Result<SavedState> state = readState(path, input.text());
  if (!state) return refuse(file, state.error());
  file.source = std::move(state->source);
  file.settings = std::move(state->settings);
  file.snapshot = std::move(state->snapshot);
  parse(file, file.source.file);
  if (!file.scene) return;
  for (const auto& [key, value] : file.settings) {
    const SettingRow* row = findSetting(key);
    if (!row || !setSetting(*file.scene, *row, value))
      return refuse(file, {ErrorCode::badFormat, path + ": found the setting " + key + " = " + shortNumber(value) +
                                                     ", expected one that this version knows"});
  }
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
  Result<InputFile> input = InputFile::open(opening.path);
  const Status started = input ? input->readUpTo(kMagicBytes) : Status(input.error());
  if (!started) {
    refuse(file, started.error());
    return file;
  }
  const bool state = isState(input->text());
  if (state || isTake(input->text())) {
    opening.kind = state ? OpeningKind::state : OpeningKind::take;
    if (!overrides.empty())
      refuse(file, {ErrorCode::invalidArgument, "--set: found with " + opening.path + ", expected with a scene file"});
    else if (state)
      readSaved(file, *input);
    else if (Result<TakeReader> take = TakeReader::open(opening.path); take)
      file.take = std::move(*take);
    else
      refuse(file, take.error());
    return file;
  }
  if (const Status read = input->readAll(kMostSceneBytes); !read) {
    refuse(file, read.error());
    return file;
  }
  file.source = {absolute(opening.path), std::move(input->text()), overrides};
  parse(file, opening.path);
  return file;
}

OpenedFile readAgain(const SceneSource& source) {
  OpenedFile file;
  file.opening.path = source.file;
  file.source = source;
  // As it is now, if it is still there; a pipe was read to its end.
  std::error_code problem;
  if (std::filesystem::is_regular_file(source.file, problem))
    if (Result<InputFile> input = InputFile::open(source.file); input && input->readAll(kMostSceneBytes))
      file.source.text = std::move(input->text());
  parse(file, source.file);
  return file;
}

}  // namespace brickfall::viewer
