// Where the scenes that come with Brickfall are.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "brickfall/scene.h"

namespace brickfall {

namespace {

namespace fs = std::filesystem;

bool holdsScenes(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".toml") return true;
  return false;
}

fs::path sceneFolder() {
  std::vector<fs::path> candidates;
  if (const char* chosen = std::getenv("BRICKFALL_SCENES"); chosen && *chosen) candidates.emplace_back(chosen);
  std::error_code error;
  fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    candidates.push_back(executable.parent_path() / ".." / ".." / "scenes");
    candidates.push_back(executable.parent_path() / ".." / "share" / "brickfall" / "scenes");
  }
  candidates.emplace_back(BRICKFALL_SOURCE_SCENES);
  // Where nothing tells where the executable is (a bare root without /proc).
  for (const char* prefix : {"/usr/local", "/usr"})
    candidates.emplace_back(fs::path(prefix) / "share/brickfall/scenes");
  for (const fs::path& folder : candidates)
    if (holdsScenes(folder)) return fs::weakly_canonical(folder, error);
  return {};
}

}  // namespace

std::vector<ShippedScene> shippedScenes() {
  std::vector<ShippedScene> scenes;
  fs::path folder = sceneFolder();
  if (folder.empty()) return scenes;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() != ".toml") continue;
    SceneLoad load = loadSceneFile(at->path().string());
    scenes.push_back({at->path().stem().string(), load.scene ? load.scene->title : std::string(), at->path().string()});
  }
  std::sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return scenes;
}

std::string findScene(const std::string& nameOrPath) {
  std::error_code error;
  if (fs::is_regular_file(nameOrPath, error)) return nameOrPath;
  bool plain = !nameOrPath.empty() && nameOrPath.find_first_of("/\\") == std::string::npos;
  fs::path folder = plain ? sceneFolder() : fs::path();
  if (folder.empty()) return {};
  for (const std::string& ending : {std::string(".toml"), std::string()}) {
    fs::path path = folder / (nameOrPath + ending);
    if (path.extension() == ".toml" && fs::is_regular_file(path, error)) return path.string();
  }
  return {};
}

std::string unknownSceneMessage(const std::string& name, const std::string& expected) {
  std::vector<std::string> names;
  std::string list;
  for (const ShippedScene& scene : shippedScenes()) {
    names.push_back(scene.name);
    list += (list.empty() ? "" : ", ") + scene.name;
  }
  return "scene: found \"" + name + "\", expected " + expected + " or one of: " + (list.empty() ? "(none)" : list) +
         didYouMean(name, names);
}

}  // namespace brickfall
