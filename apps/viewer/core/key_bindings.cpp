#include "viewer_core/key_bindings.h"

#include <algorithm>
#include <cctype>

namespace brickfall::viewer {

namespace {

using A = Action;

constexpr bool kHeld = true;

// In the order of help.
constexpr KeyBinding kBindings[] = {
    {A::runOrPause, "Space", "Time", "Run or pause"},
    {A::step, ".", "Time", "One step"},
    {A::stepBack, ",", "Time", "One step back"},
    {A::slower, "[", "Time", "Half the speed"},
    {A::faster, "]", "Time", "Twice the speed"},
    {A::normalSpeed, "\\", "Time", "Speed as in life"},
    {A::rewindSecond, "J", "Time", "One second back"},
    {A::forwardSecond, "L", "Time", "One second forward, after going back"},
    {A::toBeginning, "Home", "Time", "To the first moment that is kept"},
    {A::toEnd, "End", "Time", "To the last moment, after going back"},
    {A::restart, "R", "Time", "From the beginning"},
    {A::undo, "Ctrl+Z", "Time", "Take back the last change: as it was before"},
    {A::undo, "Backspace", "Time", "Take back the last change: as it was before"},

    {A::selectTool, "1", "Hands", "Tool: select a body"},
    {A::shootTool, "2", "Hands", "Tool: shoot balls"},
    {A::dragTool, "3", "Hands", "Tool: drag a body by a spring"},
    {A::removeTool, "4", "Hands", "Tool: remove a body"},
    {A::blastTool, "5", "Hands", "Tool: a blast"},
    {A::cutTool, "6", "Hands", "Tool: cut a body off its joints"},
    {A::shootCentre, "F", "Hands", "Shoot a ball at the middle of the picture"},
    {A::removeSelected, "Delete", "Hands", "Remove the selected body"},
    {A::letGo, "Escape", "Hands", "Let go of the selected body; close the list of files or help"},
    {A::wakeAll, "K", "Hands", "Wake everything"},
    {A::tiltLeft, "N", "Hands", "Tilt the ground to the left"},
    {A::tiltRight, "M", "Hands", "Tilt the ground to the right"},
    {A::jerkGround, "B", "Hands", "Shake the ground: a jerk to one side and the other in turn"},
    {A::smallerBall, "-", "Hands", "Smaller balls"},
    {A::largerBall, "=", "Hands", "Larger balls"},
    {A::slowerBall, "9", "Hands", "Slower balls"},
    {A::fasterBall, "0", "Hands", "Faster balls"},

    {A::forward, "W", "Camera", "Forward", kHeld},
    {A::back, "S", "Camera", "Back", kHeld},
    {A::left, "A", "Camera", "To the left", kHeld},
    {A::right, "D", "Camera", "To the right", kHeld},
    {A::up, "E", "Camera", "Up", kHeld},
    {A::down, "Q", "Camera", "Down", kHeld},
    {A::turnLeft, "Left", "Camera", "Turn to the left", kHeld},
    {A::turnRight, "Right", "Camera", "Turn to the right", kHeld},
    {A::turnUp, "Up", "Camera", "Turn up", kHeld},
    {A::turnDown, "Down", "Camera", "Turn down", kHeld},
    {A::orbitCamera, "O", "Camera", "About a point"},
    {A::flyCamera, "P", "Camera", "Flying"},
    {A::followSelected, "T", "Camera", "Follow the selected body"},
    {A::frameAll, "G", "Camera", "Everything in the picture"},
    {A::nextView, "V", "Camera", "Next view of the scene file"},

    {A::collisions, "C", "View", "Colliding bodies in red"},
    {A::wireframe, "X", "View", "Unshaded polygons"},
    {A::colliders, "F2", "View", "Shapes that collide"},
    {A::boundsTree, "F3", "View", "Boxes of the broad phase"},
    {A::contactPoints, "F4", "View", "Contact points with normals and forces"},
    {A::islands, "F5", "View", "Islands"},
    {A::asleep, "F6", "View", "What sleeps"},
    {A::shadows, "F7", "View", "Shadows: depth, stencil, none"},
    {A::mortar, "F8", "View", "Mortar: by utilisation, by damage, as it is"},
    {A::panel, "Tab", "View", "Panel"},
    {A::help, "F1", "View", "Help"},
    {A::fullScreen, "F11", "View", "Full screen"},

    {A::openScene, "Ctrl+O", "Files", "List of files: open a scene, a take or a saved state"},
    {A::saveState, "Ctrl+S", "Files", "Save the state"},
    {A::loadState, "Ctrl+L", "Files", "Load the saved state"},
    {A::saveScene, "Ctrl+E", "Files", "Save what is shown as a scene file"},
    {A::record, "Ctrl+R", "Files", "Record a take, or stop recording"},
    {A::saveStill, "F12", "Files", "Save a picture"},
    {A::copyView, "Ctrl+C", "Files", "Copy this view as a [[camera]] of a scene file"},
    {A::quit, "Ctrl+Q", "Files", "Quit"},
};

constexpr MouseBinding kMouse[] = {
    {"Left button", "The tool: select, shoot, drag, remove, blast or cut"},
    {"Right button, drag", "Turn the camera"},
    {"Middle button, drag", "Move the camera across the picture"},
    {"Wheel", "Nearer and further; while dragging a body, bring it nearer or push it away"},
    {"Double click", "With the tool to select: look at that point"},
};

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::span<const KeyBinding> keyBindings() { return kBindings; }
std::span<const MouseBinding> mouseBindings() { return kMouse; }

Action actionFor(std::string_view key, bool ctrl, bool shift) {
  for (const KeyBinding& binding : kBindings) {
    const bool wantsCtrl = binding.key.starts_with("Ctrl+");
    const std::string_view plain = wantsCtrl ? binding.key.substr(5) : binding.key;
    if (wantsCtrl == ctrl && (!shift || binding.held) && same(plain, key)) return binding.action;
  }
  return Action::count;
}

const KeyBinding& bindingOf(Action action) {
  return *std::find_if(std::begin(kBindings), std::end(kBindings),
                       [&](const KeyBinding& binding) { return binding.action == action; });
}

}  // namespace brickfall::viewer
