// Scene files: TOML in, a World out. docs/scene-file.md documents every key.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brickfall/machines.h"
#include "brickfall/masonry.h"
#include "brickfall/report.h"
#include "brickfall/scenery.h"
#include "brickfall/world.h"

namespace brickfall {

enum class Severity : std::uint8_t { error, warning };

// One mistake of a scene file. Formats as "file:line:column: error: key: found ..., expected ... (did you mean ...?)".
struct Diagnostic {
  Severity severity = Severity::error;
  std::string file;
  int line = 0, column = 0;  // from 1; 0 = the file as a whole, or a --set
  std::string key;           // dotted path, "wall[0].courses"
  std::string message;       // found, expected, nearest key
};
std::string format(const Diagnostic& diagnostic);

struct MaterialDef {
  std::string name;
  Material material;
  std::uint32_t colour = 0xB5543A;  // 0xRRGGBB
};

// A kind of mortar by its name.
struct MortarKind {
  std::string name;
  MortarStrength strength;
  double density = 1900;   // kg/m3
  double headFilling = 1;  // 0 .. 1: upright joints withstand so much of it; 0: they are open
  double scatter = 0;      // 0 .. 1: coefficient of variation from joint to joint, of strengths and energies together
};

// A kind of brick by its name: its size and hollows, and what it is made of unless a wall says so.
struct BrickKind {
  std::string name;
  BrickFormat format;
  std::string material = "brick";
};

// Where something stands in its file, from 1; 0 = not in a file.
struct SourcePlace {
  int line = 0, column = 0;
};

struct SceneWall {
  WallDef wall;
  std::string material = "brick";
  std::string lintelMaterial = "concrete";
  double densityScatter = 0;  // 0 .. 0.5: each brick's density is the material's times 1 +- up to this
  UnevenDensity uneven;       // inside each brick, by the scene's seed and the brick's name
  // None: dry. It fills the joints; mortared walls that meet are joined by the weaker mortar of both.
  std::optional<MortarKind> mortar;
  bool foot = false;                    // mortared to what it stands on: boxes and planes
  std::optional<std::uint32_t> colour;  // 0xRRGGBB, of its bricks; none: the material's
  std::vector<std::string> tiedTo;      // walls that its ends go into, by name; WallDef has what became of it
  SourcePlace place;
  std::vector<SourcePlace> openingPlaces;  // as many as wall.openings, or none
};

// A body placed by itself.
struct SceneBody {
  std::string name;
  BodyRole role = BodyRole::body;
  std::string material;
  std::vector<std::string> shapeMaterials;  // one per shape; empty: `material` for all
  BodyDef def;                              // shapes get the material's values when the scene is built
  double launchTime = 0;  // s: until then the body is held where it is, then it is let go with its velocity
  std::vector<double>
      shots;        // s, ascending: at each of them one more such body appears ("name/0"); empty: it is there by itself
  MotionPath path;  // of a kinematic body; no keys: it has none
  std::optional<std::uint32_t> colour;  // 0xRRGGBB; none: the material's
  SourcePlace place;
};

// A joint between two bodies by their names.
struct SceneJoint {
  std::string name, bodyA, bodyB;
  JointDef def;  // bodyA and bodyB are set when the scene is built
  SourcePlace place;
};

// Mortar between two bodies by their names.
struct SceneMortar {
  std::string bodyA, bodyB;  // no bodyB: all that lie face to face with bodyA
  MortarKind kind;
  double gap = 1e-3;          // m: faces further apart are not joined
  std::vector<Vec3> outline;  // as that of MortarDef; none: the face that the two share
  SourcePlace place;
};

// A machine and what it moves: a kinematic body by its name, or with none everything, in the frame of the ground.
struct SceneTilt {
  std::string body;
  Tilt tilt;
};
struct SceneShake {
  std::string body;
  Shake shake;
};

// What moves the bodies of a scene.
enum class SceneMethod : std::uint8_t {
  clusters,  // the engine: World::step
  report,    // ReportRun, for comparison
};

struct SceneDescription {
  std::string file;  // as it was given, for messages
  std::string name;  // of the file, without folder and ending
  std::string title, description;
  WorldDef world;
  SceneMethod method = SceneMethod::clusters;
  ReportSettings report;              // of SceneMethod::report
  double seconds = 10;                // simulated time of a run, at most
  bool stopAtRest = false;            // it ends when everything rests and nothing is to come
  std::optional<double> removeBelow;  // m: dynamic bodies whose centres are lower are taken out
  double timeStep = 1.0 / 60;         // s
  int substeps = 1;
  double framesPerSecond = 60;  // of the recorded take
  std::uint64_t seed = 1;
  std::vector<MaterialDef> materials;
  std::set<std::string> masonryMaterials;  // of arches and domes: like walls' materials and "brick", they make bricks
  std::vector<SceneWall> walls;
  std::vector<SceneBody> bodies;  // the ground, balls and free bodies
  std::vector<SceneJoint> joints;
  std::vector<SceneMortar> mortars;  // besides those of walls
  std::vector<SceneTilt> tilts;
  std::vector<SceneShake> shakes;
  std::vector<Wind> winds;
  std::vector<Blast> blasts;
  std::vector<Camera> cameras;
};

struct SceneLoad {
  std::optional<SceneDescription> scene;  // absent if there is an error
  std::vector<Diagnostic> diagnostics;    // the mistakes of the file, in its order: the first 100 and how many follow
};
// Overrides are "key.path=value" pairs as of --set, applied before anything is checked.
using Overrides = std::vector<std::pair<std::string, std::string>>;
SceneLoad loadSceneFile(const std::string& path, const Overrides& overrides = {});
SceneLoad parseScene(std::string_view text, const std::string& fileName, const Overrides& overrides = {});
// " (did you mean \"x\"?)", where one of the known words is near; else nothing. For messages about what a user typed.
std::string didYouMean(std::string_view word, const std::vector<std::string>& known);
// brick, steel, concrete, wood, rubber: what a scene file may name without defining it.
const std::vector<MaterialDef>& predefinedMaterials();
// lime, cement.
const std::vector<MortarKind>& predefinedMortars();
// uk, uk_frogged, uk_perforated, as3700, as3700_perforated.
const std::vector<BrickKind>& predefinedBricks();

// A scene that comes with Brickfall.
struct ShippedScene {
  std::string name, title, path;
};
// By name. Looked for in $BRICKFALL_SCENES, beside the executable (../../scenes, ../share/brickfall/scenes) and in the
// source tree it was built from; the first folder that holds scenes counts.
std::vector<ShippedScene> shippedScenes();
// The path of a scene file, given a path or a shipped scene's name; empty if there is no such file.
std::string findScene(const std::string& nameOrPath);
// For who typed a name that findScene does not know: what was found, what could have been meant. `expected`: what is taken
// besides the names of shipped scenes ("a scene file").
std::string unknownSceneMessage(const std::string& name, const std::string& expected);

// Overlapping bodies at the start and the like, as warnings at the tables that they come from.
std::vector<Diagnostic> checkScene(const SceneDescription& scene);

namespace scene {
struct BrickJoint;
}

// A body of a scene, placed in a world.
struct PlacedBody {
  BodyId id;
  std::string name;
  BodyRole role = BodyRole::body;
  std::uint32_t colour = 0;
  BodyDef def;                         // as created, with shapes and materials
  std::vector<std::string> materials;  // of its shapes, by name; none for bodies that were given without
  double launchTime = 0;
  int course = -1;  // of a brick
  SourcePlace place;
};

// What is drawn of a body, where that is not what collides: bricks in mortar are drawn as they are laid, with their mortar.
struct DrawnBody {
  std::vector<ShapeDef> shapes;        // their materials are not read
  std::vector<std::string> materials;  // of each
};

// A scene being simulated: the world, what is in it, and what is still to be launched. Bodies that come or go while it runs are
// created and destroyed through it, so that they have a name, a role and a colour, or through world(), which knows none of these.
class SceneRun {
 public:
  static Result<SceneRun> create(const SceneDescription& scene);
  // One time step of the scene; launches what is due first, and lets its machines act. Under SceneMethod::report the world's own clock stands still.
  Result<StepReport> step();
  World& world() { return world_; }
  const World& world() const { return world_; }
  const SceneDescription& scene() const { return scene_; }
  // As they were placed, those of the scene first. One that was destroyed through world() is still listed.
  const std::vector<PlacedBody>& bodies() const { return bodies_; }
  // The scene's joints that are still there, in its order. Others are in world().joints().
  std::vector<std::pair<JointId, std::string>> joints() const;
  // The scene's mortar as it was made, what is broken as well. Ends of bodies end it.
  const std::vector<MortarId>& mortars() const { return mortars_; }
  const PlacedBody* find(BodyId id) const;  // null for a body that is not listed
  const DrawnBody* drawn(BodyId id) const;  // null: it is drawn as it is
  // 0xRRGGBB, of what is drawn of a body, shape by shape: its own, and those of its other materials. Mortar has one.
  std::vector<std::uint32_t> colours(BodyId id) const;
  // `id` of what is given is not read; with a launchTime to come a body that can move is held until then.
  Result<BodyId> createBody(PlacedBody body);
  Status destroyBody(BodyId id);
  double time() const { return time_; }  // s, simulated so far
  // All that can move sleeps, and nothing is to come: no launch, no shot, no machine that moves a body yet.
  bool atRest() const;
  std::uint64_t stepCount() const { return stepsDone_; }

  // --- Changes while it runs; scene() shows them. On an error nothing changes.
  Status setTimeStep(double timeStep, int substeps);  // as World::step takes them
  Status setWorld(const WorldDef& def);               // as World::setDefinition
  // Another density, friction or restitution of all that is made of it; where densities are scattered they stay so. A name of
  // predefinedMaterials() that the scene does not define becomes the scene's own. Bodies in quarantine keep what they had.
  Status setMaterial(const std::string& name, const Material& material);
  // The scene's own, or a predefined one; none: there is none of that name.
  std::optional<MaterialDef> material(const std::string& name) const;

  // --- State as a whole: the world, who is in it and under what name, launches to come, what the changes above changed. Goes on
  // bit for bit in a run of the same scene, this one or another.
  std::vector<std::byte> snapshot() const;
  Status restore(std::span<const std::byte> snapshot);  // on any error the run stays as it was
  // SceneMethod::report: who collided in the last step; else null.
  const ReportRun* reported() const { return reported_ ? &*reported_ : nullptr; }

 private:
  friend class RunArchive;
  void list(std::vector<PlacedBody> bodies);
  SceneRun(SceneDescription scene, World world);
  struct Shot {
    double time = 0;
    PlacedBody body;
  };
  Result<BodyId> place(PlacedBody body);
  Status hold(BodyId id);
  Status join();
  Status mortar(const std::vector<scene::BrickJoint>& ofWalls);
  Result<std::vector<std::pair<BodyId, std::vector<Vec3>>>> facesOf(const SceneMortar& mortar,
                                                                    const std::map<std::string, BodyId>& byName) const;
  Status placeMachines();
  Status launchWaiting();
  Status shoot();
  Status removeFallen();
  SceneDescription scene_;
  World world_;
  std::vector<PlacedBody> bodies_;
  std::vector<std::size_t> placeByIndex_;  // by BodyId::index: position in bodies_, where that id is
  std::vector<BodyId> waiting_;            // still to be launched
  std::vector<JointId> joints_;            // of scene_.joints
  std::vector<MortarId> mortars_;
  std::map<std::string, DrawnBody> drawn_;  // by name; nothing changes it
  std::vector<Shot> shots_;                 // all of the scene
  Machines machines_;
  std::optional<ReportRun> reported_;  // SceneMethod::report
  std::uint64_t stepsDone_ = 0;
  double time_ = 0;
};

}  // namespace brickfall
