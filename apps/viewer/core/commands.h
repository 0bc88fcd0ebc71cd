// What a user can do to a run, as values: the window sends them, the simulation thread carries them out in order, between two
// steps, and answers each one. Bodies are named by serial, so that a command never means another body than the one seen.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "brickfall/math.h"
#include "brickfall/result.h"
#include "brickfall/scene.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

struct Ray {
  Vec3 origin;     // m
  Vec3 direction;  // unit
};

// --- What is shown.
// A scene file, a shipped scene's name, a take or a saved state: told apart by what is in it. It begins paused or running as
// `run` says. What was shown before goes on being shown if it can't be opened.
struct OpenedFile;  // opening.h
struct Open {
  std::string nameOrPath;
  Overrides overrides;  // of a scene, as --set
  bool run = true;
  std::shared_ptr<OpenedFile> read;  // what was read of it before, used up by this; null: it is read now
};
// The scene from its beginning. Settings of the panel stay, also those that waited for this; `asInFile` forgets them all.
// A take: its first frame.
struct Restart {
  bool asInFile = false;
};

// --- Time.
struct Run {};
struct Pause {};
// Pauses, and makes this many steps (take: frames). Negative: back, as Rewind.
struct Step {
  int count = 1;
};
struct SetSpeed {
  double factor = 1;  // kSlowest .. kFastest: how often it is stepped; the time step stays
};
constexpr double kSlowest = 0.01, kFastest = 16;
// Pauses at that time, within RunStatus::earliest .. latest, exactly as it was then. What lay ahead stays in reach until the run
// goes on (Run, Step or any change): then it is forgotten. A take: seeks.
struct Rewind {
  double time = 0;  // s
};
// As it was before the last change by the user.
struct Undo {};

// --- Hands.
struct ShootBall {
  Ray ray;                         // the ball's centre starts at its origin
  double radius = 0.1;             // m
  double speed = 10;               // m/s
  std::string material = "steel";  // of the scene, or one of predefinedMaterials()
};
// A spring takes hold of a body at a point and pulls it to a target: critically damped, and never harder than the limit.
// One at a time; it lets go when the body is removed.
struct DragBegin {
  Serial body = 0;
  Vec3 local;            // m, in the body's frame: where it is held (PickHit::local)
  double strength = 20;  // largest pull, in weights of the body (at 9.81 m/s2)
};
struct DragMove {
  Vec3 target;  // m, world
};
struct DragEnd {};
struct RemoveBody {
  Serial body = 0;
};
struct WakeBody {
  Serial body = 0;  // 0: all
};
// A blast (brickfall/machines.h).
struct Explode {
  Vec3 centre;            // m
  double impulse = 5000;  // N s, over all directions
  double radius = 5;      // m
};
// All joints of a body end: a chain is cut.
struct CutJoints {
  Serial body = 0;
};
// The ground tilts by so much about an axis, as seen by who stands on it: gravity turns.
struct TiltGround {
  Vec3 axis;  // its length does not matter
  double degrees = 0;
};
// The ground is jerked: all that can move has lost this velocity against it.
struct KickGround {
  Vec3 velocity;  // m/s
};
// For the panel only: changes nothing. 0: none.
struct Select {
  Serial body = 0;
};

// --- Settings. The key is that of a row of settingRows().
struct ChangeSetting {
  std::string key;
  double value = 0;
};
struct ChangeMaterial {
  std::string name;
  double density = 0, friction = 0, restitution = 0, rollingResistance = 0;
};

// --- Files: whole or not at all.
struct SaveState {
  std::string path;
};
// From now on, into "<path>.part" until it is stopped; rewinding, undoing, restarting and opening stop it first.
struct StartRecording {
  std::string path;
};
struct StopRecording {};

using Command = std::variant<Open, Restart, Run, Pause, Step, SetSpeed, Rewind, Undo, ShootBall, DragBegin, DragMove,
                             DragEnd, RemoveBody, WakeBody, Explode, CutJoints, TiltGround, KickGround, Select,
                             ChangeSetting, ChangeMaterial, SaveState, StartRecording, StopRecording>;

// "shoot a ball", for messages and the log.
const char* nameOf(const Command& command);

struct CommandResult {
  std::uint64_t ticket = 0;  // as Session::send gave it; 0: of no command
  bool ok = true;
  ErrorCode code = ErrorCode::none;
  std::string message;  // what was wrong, found and expected; or what was done ("saved wall.state, 1.2 MB")
  std::vector<std::string> details;  // of Open: each diagnostic of the scene file, with line and column
};

}  // namespace brickfall::viewer
