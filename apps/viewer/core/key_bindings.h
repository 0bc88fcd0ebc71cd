// Which key does what: one table, of which the window's keys, its help and docs/viewer.md are made.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace brickfall::viewer {

enum class Action : std::uint8_t {
  // time
  runOrPause,
  step,
  stepBack,
  slower,
  faster,
  normalSpeed,
  restart,
  undo,
  rewindSecond,
  forwardSecond,
  toBeginning,
  toEnd,
  // hands
  selectTool,
  shootTool,
  dragTool,
  removeTool,
  blastTool,
  cutTool,
  shootCentre,
  removeSelected,
  letGo,
  wakeAll,
  tiltLeft,
  tiltRight,
  jerkGround,
  smallerBall,
  largerBall,
  slowerBall,
  fasterBall,
  // camera: those held act as long as the key is down
  forward,
  back,
  left,
  right,
  up,
  down,
  turnLeft,
  turnRight,
  turnUp,
  turnDown,
  orbitCamera,
  flyCamera,
  followSelected,
  frameAll,
  nextView,
  // view
  collisions,
  wireframe,
  colliders,
  boundsTree,
  contactPoints,
  islands,
  asleep,
  shadows,
  mortar,
  panel,
  help,
  fullScreen,
  // files
  openScene,
  saveState,
  loadState,
  saveScene,
  record,
  saveStill,
  copyView,
  quit,
  count
};
constexpr int kActionCount = int(Action::count);

struct KeyBinding {
  Action action;
  std::string_view
      key;  // as SDL_GetKeyName has it: "Space", "R", "Left", "F1"; "Ctrl+Z" and "Shift+..." with modifiers
  std::string_view group;  // "Time", "Hands", "Camera", "View", "Files"
  std::string_view help;   // "Run or pause"
  bool held = false;       // acts as long as the key is down
};

// In the order of help. Each action at least once; a key once.
std::span<const KeyBinding> keyBindings();
// `key` as SDL names it, any case; Action::count: none. A held action also acts with Shift down (faster).
Action actionFor(std::string_view key, bool ctrl, bool shift);
const KeyBinding& bindingOf(Action action);  // its first

// What the mouse does, for help and docs.
struct MouseBinding {
  std::string_view button, help;
};
std::span<const MouseBinding> mouseBindings();

}  // namespace brickfall::viewer
