// A scene while it is read: what is known so far, and the parts that read each kind of table.
#pragma once
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "brickfall/limits.h"
#include "brickfall/scene.h"
#include "scene/table_reader.h"

namespace brickfall::scene {

constexpr double kRadians = std::numbers::pi / 180;  // in a degree

// A shot at something that has a name: what that is may stand later in the file.
struct NamedAim {
  TableReader reader;
  std::string body, at;
  double speed = 0;
  bool high = false;
};

struct SceneBuild {
  ReadContext context;
  SceneDescription scene;
  std::map<std::string, int> names;  // of walls, bodies, balls and arrays, with their lines
  std::int64_t bodyCount = 0;        // bricks included
  std::vector<NamedAim> aims;
  std::unique_ptr<World> trial;  // where bodies are made to see whether they can be
  std::vector<MortarKind> mortarKinds;
  std::map<std::string, std::shared_ptr<const MeshTree>> meshes;  // by file and scale; null: could not be read

  // The name in the table, or kind + number ("wall2"); a name given twice is an error.
  std::string nameOf(TableReader& reader, const char* kind, std::size_t index);
  // false (and an error at the table) if the scene would have too many bodies with these.
  bool roomFor(TableReader& reader, const std::string& key, std::int64_t bodies);
  // What only the engine can tell of a body (is the hull one, is the mass in its range): an error at the table.
  void checkBuildable(TableReader& reader, const SceneBody& body);
};

void readWorld(SceneBuild& build, TableReader& top);
void readGround(SceneBuild& build, TableReader& top);
void readMaterials(SceneBuild& build, TableReader& top);
void readBrickKinds(SceneBuild& build, TableReader& top);
void readMortarKinds(SceneBuild& build, TableReader& top);
void readCameras(SceneBuild& build, TableReader& top);
void readWalls(SceneBuild& build, TableReader& top);
void readPiers(SceneBuild& build, TableReader& top);
void readRoofs(SceneBuild& build, TableReader& top);
void readBodies(SceneBuild& build, TableReader& top);
void readBalls(SceneBuild& build, TableReader& top);
void readArrays(SceneBuild& build, TableReader& top);
void readArches(SceneBuild& build, TableReader& top);
void readDomes(SceneBuild& build, TableReader& top);
void readJoints(SceneBuild& build, TableReader& top);
void readMortars(SceneBuild& build, TableReader& top);
void readChains(SceneBuild& build, TableReader& top);
void readTilts(SceneBuild& build, TableReader& top);
void readShakes(SceneBuild& build, TableReader& top);
void readWinds(SceneBuild& build, TableReader& top);
void readBlasts(SceneBuild& build, TableReader& top);

// The mesh that a table's `file` and `scale` ask for; null if it could not be read, which is said at `file`.
std::shared_ptr<const MeshTree> readMesh(SceneBuild& build, TableReader& reader);

// Lines of files that are included are not known to who reads the place: 0.
inline SourcePlace placeOf(const TableReader& reader) {
  if (reader.node().source > 0) return {};
  return {reader.node().line, reader.node().column};
}

inline void readColour(TableReader& reader, SceneBody& body) {
  std::uint32_t colour = 0;
  if (reader.colour("colour", colour)) body.colour = colour;
}
// A table's shape: the keys of [[body]], [[body.part]] and [[array]].
ShapeDef readShape(SceneBuild& build, TableReader& reader);

// A camera that sees the whole scene, for files that have none.
void frameScene(SceneDescription& scene);

// A table's `mortar` and `foot`; none of "none".
std::optional<MortarKind> readOwnMortar(SceneBuild& build, TableReader& reader, bool& foot);
// The name of a body that is there, or may be a brick; without the key it is the ground's. With a point also that of a wall or
// another thing of many bodies: then the name becomes that of the body nearest to the point.
bool readJoined(SceneBuild& build, TableReader& reader, const char* key, std::string& name,
                const Vec3* point = nullptr);
// m: the middle of a body or of what many bodies are called after; none, and an error at the key, if there is no such thing.
std::optional<Vec3> middleOf(SceneBuild& build, TableReader& reader, const char* key, const std::string& name);
// Of the bodies that are called so, or after it, the one nearest to the point; empty: there are none.
std::string nearestOf(const SceneBuild& build, const std::string& name, Vec3 point);
// Shots at what has a name, once everything has been read.
void takeAims(SceneBuild& build);

// The keys that bodies, balls and arrays share.
void readMotion(TableReader& reader, BodyDef& def);
// How a body is let go: when, how often, and where it is aimed.
void readLaunch(SceneBuild& build, TableReader& reader, SceneBody& body);
// [[body.key]]; a body that is not kinematic has none.
void readPath(TableReader& reader, SceneBody& body);

}  // namespace brickfall::scene
