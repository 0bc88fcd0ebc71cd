// A scene file from its text to a SceneDescription, with all of its mistakes.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "brickfall/scene.h"
#include "scene/expand.h"
#include "scene/include_files.h"
#include "scene/overrides.h"
#include "scene/scene_build.h"
#include "scene/toml_document.h"

namespace brickfall {

namespace {

constexpr std::size_t kMaxFileBytes = 16u << 20;
constexpr std::size_t kMostDiagnostics = 100;

SceneLoad failed(const std::string& file, std::string message) {
  SceneLoad load;
  load.diagnostics.push_back({Severity::error, file, 0, 0, "", std::move(message)});
  return load;
}

bool isBlank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == std::string_view::npos; }

void readAll(scene::SceneBuild& build, scene::Node& root) {
  scene::readParameters(build.context, root);
  scene::expandScene(build.context, root);
  scene::TableReader top(build.context, root, "", "");
  top.text("title", build.scene.title);
  top.text("description", build.scene.description);
  scene::readMaterials(build, top);  // first: the others name them
  scene::readBrickKinds(build, top);
  scene::readMortarKinds(build, top);
  scene::readWorld(build, top);
  scene::readGround(build, top);
  scene::readWalls(build, top);
  scene::readPiers(build, top);
  scene::readArrays(build, top);
  scene::readArches(build, top);
  scene::readDomes(build, top);
  scene::readRoofs(build, top);
  scene::readBodies(build, top);
  scene::readBalls(build, top);
  scene::readChains(build, top);
  scene::readJoints(build, top);  // they name links, too
  scene::readMortars(build, top);
  scene::readTilts(build, top);  // they name bodies
  scene::readShakes(build, top);
  scene::readWinds(build, top);
  scene::readBlasts(build, top);
  scene::readCameras(build, top);
  scene::takeAims(build);
  bool anything = top.has("wall") || top.has("pier") || top.has("roof") || top.has("body") || top.has("ball") ||
                  top.has("array") || top.has("arch") || top.has("dome");
  if (!anything && !build.context.syntaxErrors) {
    scene::Node file;
    build.context.error(
        file, "",
        "found nothing to simulate, expected at least one [[wall]], [[pier]], [[roof]], [[body]], [[ball]], "
        "[[array]], [[arch]] or [[dome]]");
  }
}

// In the order of the file; what comes from --set first.
void sortByPlace(std::vector<Diagnostic>& diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& a, const Diagnostic& b) {
    if (a.file != b.file && a.line > 0 && b.line > 0) return a.file < b.file;
    return a.line != b.line ? a.line < b.line : a.column < b.column;
  });
}

// A file that is something else altogether: the first mistakes tell as much as all of them.
void keepTheFirst(std::vector<Diagnostic>& diagnostics, const std::string& file) {
  if (diagnostics.size() <= kMostDiagnostics) return;
  std::string more = std::to_string(diagnostics.size() - kMostDiagnostics);
  diagnostics.resize(kMostDiagnostics);
  diagnostics.push_back({Severity::error, file, 0, 0, "", "found " + more + " more mistakes, expected none"});
}

}  // namespace

SceneLoad parseScene(std::string_view text, const std::string& fileName, const Overrides& overrides) {
  if (!(text.size() <= kMaxFileBytes)) return failed(fileName, "found a file of over 16 MiB, expected a scene file");
  if (isBlank(text)) return failed(fileName, "found an empty file, expected a scene (docs/scene-file.md)");
  scene::TomlDocument document = scene::readToml(text, fileName);
  SceneLoad load;
  if (!document.usable) {
    load.diagnostics = std::move(document.errors);
    return load;
  }
  scene::SceneBuild build;
  build.context.file = fileName;
  build.context.syntaxErrors = !document.errors.empty();
  build.context.diagnostics = std::move(document.errors);
  build.scene.file = fileName;
  build.scene.name = std::filesystem::path(fileName).stem().string();
  build.context.sources = {fileName};
  scene::mergeIncludes(build.context, document.root);
  for (const auto& [key, value] : overrides) scene::applyOverride(build.context, document.root, key, value);
  readAll(build, document.root);
  load.diagnostics = std::move(build.context.diagnostics);
  sortByPlace(load.diagnostics);
  bool sound = std::none_of(load.diagnostics.begin(), load.diagnostics.end(),
                            [](const Diagnostic& d) { return d.severity == Severity::error; });
  keepTheFirst(load.diagnostics, fileName);
  if (!sound) return load;
  if (build.scene.cameras.empty()) scene::frameScene(build.scene);
  load.scene = std::move(build.scene);
  return load;
}

SceneLoad loadSceneFile(const std::string& path, const Overrides& overrides) {
  std::error_code ignored;
  std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) return failed(path, "there is no such file, expected a scene file");
  if (std::filesystem::is_directory(status)) return failed(path, "found a folder, expected a scene file");
  if (std::filesystem::is_regular_file(status) && !(std::filesystem::file_size(path, ignored) <= kMaxFileBytes))
    return failed(path, "found a file of over 16 MiB, expected a scene file");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (!file.is_open() || file.bad() || text.bad()) return failed(path, "the file can't be read, expected a scene file");
  return parseScene(text.str(), path, overrides);
}

namespace scene {

std::string SceneBuild::nameOf(TableReader& reader, const char* kind, std::size_t index) {
  std::string name;
  if (reader.text("name", name)) {
    auto [known, fresh] = names.emplace(name, reader.node().line);
    std::string first = known->second > 0 ? " (first at line " + std::to_string(known->second) + ")" : std::string();
    if (!fresh)
      reader.error("name", "found the name \"" + name + "\" a second time" + first + ", expected different names");
    return name;
  }
  for (std::size_t number = index + 1;; number++) {
    name = kind + std::to_string(number);
    if (names.emplace(name, reader.node().line).second) return name;
  }
}

void SceneBuild::checkBuildable(TableReader& reader, const SceneBody& body) {
  auto densityOf = [&](const std::string& name) {
    for (const MaterialDef& material : scene.materials)
      if (material.name == name) return material.material;
    return Material{};
  };
  BodyDef def = body.def;
  for (std::size_t i = 0; i < def.shapes.size(); i++)
    def.shapes[i].material = densityOf(i < body.shapeMaterials.size() ? body.shapeMaterials[i] : body.material);
  if (!trial) trial = std::make_unique<World>(std::move(World::create({})).value());
  Result<BodyId> made = trial->createBody(def);
  if (made) {
    (void)trial->destroyBody(*made).ok();
    return;
  }
  // "shapes[0].vertices: found ..." is the engine's word for what the file calls otherwise.
  const std::string& why = made.error().message;
  reader.error(why.find("vertices") == std::string::npos || !reader.has("vertices") ? "" : "vertices",
               why.substr(std::min(why.find("found"), why.size())));
}

bool SceneBuild::roomFor(TableReader& reader, const std::string& key, std::int64_t bodies) {
  bodyCount += bodies;
  if (bodyCount <= scene_limits::kMostBodies) return true;
  bool before = bodyCount - bodies > scene_limits::kMostBodies;  // said once
  if (!before)
    reader.error(key, "the scene has " + std::to_string(bodyCount) + " bodies with these, expected at most " +
                          std::to_string(scene_limits::kMostBodies));
  return false;
}

}  // namespace scene

}  // namespace brickfall
