#include "cli/scene_choice.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "cli/commands.h"
#include "cli/console.h"

namespace brickfall::cli {
namespace {

bool looksLikePath(const std::string& text) { return text.find('/') != std::string::npos || text.ends_with(".toml"); }

constexpr std::size_t kMostBytes = 16u << 20;  // of a scene file

// The whole file, or a little more than a scene file may have (a device never ends; parseScene refuses that). Read here, since
// streams do not tell why reading failed.
Result<std::string> contentOf(const std::string& path) {
  const bool standardInput = path == "-";
  const auto refused = [&] {
    return Error{ErrorCode::inputOutput, fmt::format("cannot read scene file '{}': {}", path, std::strerror(errno))};
  };
  const int file = standardInput ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return refused();
  std::string text;
  std::vector<char> block(1 << 16);
  while (text.size() <= kMostBytes) {
    const ssize_t count = read(file, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const Error error = refused();
      close(file);
      return error;
    }
    if (count == 0) break;
    text.append(block.data(), std::size_t(count));
  }
  close(file);
  return text;
}

}  // namespace

SceneChoice chooseScene(const std::string& nameOrPath, const Overrides& overrides) {
  SceneChoice choice;
  choice.path = nameOrPath == "-" ? nameOrPath : findScene(nameOrPath);
  if (choice.path.empty() && !looksLikePath(nameOrPath)) {
    choice.exitCode = kBadInput;
    choice.problem = unknownSceneMessage(nameOrPath, "a scene file");
    return choice;
  }
  if (choice.path.empty()) choice.path = nameOrPath;
  const Result<std::string> text = contentOf(choice.path);
  if (!text) {
    choice.exitCode = kFileError;
    choice.problem = text.error().message;
    return choice;
  }
  SceneLoad load = parseScene(*text, choice.path == "-" ? "stdin" : choice.path, overrides);
  choice.diagnostics = std::move(load.diagnostics);
  choice.scene = std::move(load.scene);
  if (!choice.scene) choice.exitCode = kBadInput;
  return choice;
}

SceneChoice chooseSceneToRun(const std::string& nameOrPath, const Overrides& overrides, std::optional<double> seconds,
                             std::optional<int> threads) {
  SceneChoice choice = chooseScene(nameOrPath, overrides);
  if (!choice.problem.empty()) complain(choice.problem);
  showDiagnostics(choice.diagnostics);
  if (!choice.scene) return choice;
  if (seconds) choice.scene->seconds = *seconds;
  if (threads) choice.scene->world.threads = *threads;
  return choice;
}

void showDiagnostics(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics) {
    const std::string line = printable(format(diagnostic)) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
  }
}

}  // namespace brickfall::cli
