// What the window shows of a run: one moment of it, as a value that never changes once it was made. The simulation thread makes
// frames, the window reads the latest; neither waits for the other. Scenes run live and takes played give the same frames.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "brickfall/body.h"
#include "brickfall/scenery.h"
#include "brickfall/shapes.h"
#include "brickfall/step_report.h"

namespace brickfall::viewer {

// Of a body, as long as the program runs: never given twice, and kept through rewinding while the body stays what it is. So
// whatever was made for a serial (a mesh) fits as long as the serial is listed. From 1; 0 = none.
using Serial = std::uint32_t;

// What of a body does not change from frame to frame.
struct ListedBody {
  Serial serial = 0;
  BodyId id;                 // in the world; null in a take
  std::uint32_t number = 0;  // its look goes by it: the place in the world, or in the take; a saved state keeps it
  std::string name;
  BodyRole role = BodyRole::body;
  std::string material;             // of its first shape, as the scene names it; empty: not known
  std::uint32_t colour = 0xB5543A;  // 0xRRGGBB
  double mass = 0;                  // kg; 0 = fixed
  double radius = 0;                // m, about its origin: of a ball around all its shapes but planes
  std::vector<ShapeDef> shapes;
  // Bricks in mortar are drawn as they are laid, with their mortar; empty: the shapes are drawn.
  std::vector<ShapeDef> drawn;
  std::vector<std::string> drawnMaterials;  // of what is drawn, shape by shape; empty: `material` for all
  std::vector<std::uint32_t> drawnColours;  // 0xRRGGBB, likewise; empty: `colour` for all
};

// The bodies of a frame. The same object from frame to frame as long as nobody comes or goes: compare pointers.
struct BodyList {
  std::vector<ListedBody> bodies;
  // Place of a serial in `bodies`, or -1. By halving: bodies lie in the order of their serials.
  int find(Serial serial) const;
};

enum class Activity : std::uint8_t { awake, asleep, fixed, held, quarantined };  // held: until its launch

// A body at the moment of the frame. In a take some of it is not known: see each.
struct FrameBody {
  Transform pose;                        // of the body's frame
  Transform before;                      // in the frame made before this one: see blendAt
  Vec3 linearVelocity, angularVelocity;  // m/s of the centre of mass; rad/s (take: found from poses)
  Activity activity = Activity::awake;   // (take: awake or fixed)
  bool touching = false;                 // presses on another now; with FrameNeeds::collisions, else false
  float sinceHit = 1e9f;     // s, simulated, since it last was in a hit: colliding bodies fade from red by it
  float hitSpeed = 0;        // m/s, at which the two met (take: guessed from impulse and mass)
  float contactForce = 0;    // N, sum of normal forces; with FrameNeeds::collisions (take: always)
  std::int32_t island = -1;  // number within the frame, -1: none; with FrameNeeds::islands (take: -1)
};

// One contact point.
struct FrameContact {
  int bodyA = 0, bodyB = 0;  // places in the list
  Vec3 point;                // m, world
  Vec3 normal;               // unit, from A to B
  float separation = 0;      // m, negative: overlap
  float normalForce = 0;     // N, on B along the normal; 0: near, not pressing
  Vec3 frictionForce;        // N, on B
};

// A mortar joint: the face that it glues.
struct FrameMortar {
  int body = 0;                       // place in the list: of its body A
  Vec3 centre;                        // m, frame of that body
  Vec3 along1, along2;                // m, frame of that body: half edges
  float utilisation = 0, damage = 0;  // 0 .. 1; damage 1: broken
};

// Of the broad phase: bounds that are kept for a shape.
struct FrameBounds {
  Aabb box;
  int body = 0;  // place in the list
};

// Numbers of one step, for plots.
struct StepSample {
  double time = 0;  // s
  std::array<float, kStageCount> stageMilliseconds{};
  float milliseconds = 0;
  int awakeBodies = 0, contactPoints = 0, touchingPoints = 0, islands = 0, restingIslands = 0, impacts = 0, cycles = 0;
};

// The selected body's numbers. The session alone knows which body that is (Select); it stays so while the body is away.
struct SelectedContact {
  Serial other = 0;
  std::string otherName;
  Vec3 point;              // m, world
  Vec3 normal;             // unit, towards the selected body
  double normalForce = 0;  // N
  Vec3 frictionForce;      // N, on the selected body
};
struct SelectedBody {
  Serial serial = 0;
  std::string name, material;
  double mass = 0;          // kg
  double speed = 0;         // m/s
  double spin = 0;          // rad/s
  double surfaceSpeed = 0;  // m/s, of a conveyor's surface (take: 0)
  Vec3 centreOfMass;        // m (take: the body's origin)
  // What is not known is not there: in a take none but the sum of normal forces, under the report's system no contacts.
  std::optional<double> kineticEnergy;  // J
  std::optional<Vec3> acceleration;     // m/s2, mean over the last step
  std::optional<double> contactForce;   // N, sum of normal forces, where the contacts are not known
  std::optional<std::vector<SelectedContact>> contacts;
  std::vector<std::string> mortar;  // lines: how its mortar is, and why it fell (mortar_story.h); empty: it has none
};

// While a body is dragged: the spring as it is drawn.
struct FrameDrag {
  Serial serial = 0;
  Vec3 grabbed;      // m, world: where it is held
  Vec3 target;       // m, world: where it is pulled to
  double force = 0;  // N, in the last step
};

enum class LogKind : std::uint8_t { note, hit, asleep, awake, launch, quarantine, warning, error };
struct LogLine {
  std::uint64_t number = 0;  // from 1, over the whole session
  double time = 0;           // s, simulated
  LogKind kind = LogKind::note;
  std::string text;
};

struct MaterialRow {
  std::string name;
  std::uint32_t colour = 0;
  double density = 0, friction = 0, restitution = 0, rollingResistance = 0;
  int shapes = 0;  // made of it
};

enum class RunKind : std::uint8_t { nothing, live, take };

// What of a run does not change while it goes on.
struct RunInfo {
  RunKind kind = RunKind::nothing;
  std::string file, name, title, description;
  std::string watched;          // file that is read again when it changes; empty: none (a saved state, a pipe)
  std::vector<Camera> cameras;  // at least one, but for RunKind::nothing
  Aabb extent;                  // m, of all that can move at the start (of everything if nothing can)
  double ground = 0;            // m: highest top of the ground's planes and boxes; kNoGround (-1e30) without one
  double seconds = 0;           // s: length of the take; how long the scene is meant to run
  bool reportMethod = false;    // moved by the report's system: no contacts, islands, bounds or stages
};

struct RunStatus {
  bool running = false;            // false: paused
  double speed = 1;                // simulated seconds a second, as asked for
  double reachedSpeed = 0;         // as it was over the last second; less than `speed`: the machine can't keep up
  std::string loading;             // what is being loaded; empty: nothing
  std::string recording;           // path of the take being recorded; empty: none
  double time = 0;                 // s, simulated
  std::uint64_t step = 0;          // of the run; frame of the take
  double earliest = 0;             // s: rewinding reaches back to here (take: 0)
  double latest = 0;               // s: and, after a rewind, forward again to here (take: its length)
  std::string undo;                // what Undo would take back ("ball"); empty: nothing
  std::size_t historyBytes = 0;    // kept for undoing and rewinding
  std::uint64_t settingsWait = 0;  // settings that were changed and take a restart
};

// What is costly to gather and only gathered when a view shows it.
struct FrameNeeds {
  bool contacts = false;    // Frame::contacts
  bool collisions = false;  // FrameBody::touching and contactForce, Frame::touchingPairs
  bool islands = false;     // FrameBody::island
  bool bounds = false;      // Frame::bounds
  bool plots = false;       // Frame::samples
  bool mortar = false;      // Frame::mortar
  bool operator==(const FrameNeeds&) const = default;
};

struct Frame {
  std::uint64_t number = 0;      // from 1; a later frame has a higher one
  double madeAt = 0;             // s of the session's clock
  std::uint64_t carriedOut = 0;  // ticket of the last command before it
  double shownFor = 0;           // s of that clock over which `before` goes over into `pose`; 0: at once
  std::shared_ptr<const RunInfo> info;
  RunStatus status;
  std::shared_ptr<const BodyList> list;
  std::vector<FrameBody> bodies;                   // one for each of the list
  std::vector<FrameContact> contacts;              // by needs, as the next four
  std::vector<std::pair<int, int>> touchingPairs;  // places in the list
  std::vector<FrameBounds> bounds;
  std::vector<FrameMortar> mortar;
  std::vector<StepSample> samples;                  // of the last kSamples steps, oldest first
  int islands = 0;                                  // how many numbers FrameBody::island has
  std::optional<StepReport> report;                 // of the last step; none before the first, and in a take
  std::shared_ptr<const std::vector<LogLine>> log;  // the last kLogLines, oldest first; never null
  std::vector<double> settings;                     // one for each of settingRows(); empty unless live
  std::vector<MaterialRow> materials;               // of the scene, those that bodies are made of; empty unless live
  std::optional<SelectedBody> selected;
  std::optional<FrameDrag> drag;
};

constexpr std::size_t kSamples = 300;
constexpr std::size_t kLogLines = 200;

// How far drawing is from `before` (0) to `pose` (1) at a time of the session's clock, so that motion is smooth at any rate.
double blendAt(const Frame& frame, double now);
Transform poseAt(const FrameBody& body, double blend);

}  // namespace brickfall::viewer
