#include "cli/scene_choice.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "cli/commands.h"
#include "cli/console.h"
#include "scene/nearest.h"

namespace brickfall::cli {
namespace {

bool looksLikePath(const std::string& text) { return text.find('/') != std::string::npos || text.ends_with(".toml"); }

std::string unknownScene(const std::string& name) {
  std::vector<std::string> names;
  std::string list;
  for (const ShippedScene& scene : shippedScenes()) {
    names.push_back(scene.name);
    list += (list.empty() ? "" : ", ") + scene.name;
  }
  return fmt::format("scene: found \"{}\", expected a scene file or one of: {}{}", name, list.empty() ? "(none)" : list,
                     scene::didYouMean(name, names));
}

}  // namespace

SceneChoice chooseScene(const std::string& nameOrPath, const Overrides& overrides) {
  SceneChoice choice;
  choice.path = findScene(nameOrPath);
  if (choice.path.empty() && !looksLikePath(nameOrPath)) {
    choice.exitCode = kBadInput;
    choice.problem = unknownScene(nameOrPath);
    return choice;
  }
  if (choice.path.empty()) choice.path = nameOrPath;
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(choice.path, ignored);
  if (folder || access(choice.path.c_str(), R_OK) != 0) {
    choice.exitCode = kFileError;
    choice.problem =
        fmt::format("cannot read scene file '{}': {}", choice.path, std::strerror(folder ? EISDIR : errno));
    return choice;
  }
  SceneLoad load = loadSceneFile(choice.path, overrides);
  choice.diagnostics = std::move(load.diagnostics);
  choice.scene = std::move(load.scene);
  if (!choice.scene) choice.exitCode = kBadInput;
  return choice;
}

void showDiagnostics(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics) {
    const std::string line = printable(format(diagnostic)) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
  }
}

}  // namespace brickfall::cli
