// Events of the window: who is to act on each, and what the mouse means.
#include <SDL.h>

#include <algorithm>
#include <cmath>

#include "viewer_window/app.h"
#include "viewer_window/panels/panels.h"

namespace brickfall::viewer {
namespace {

constexpr double kTurnPerPixel = 0.006;  // rad
constexpr double kTurnPerSecond = 1.2;   // rad, by keys

// Of a tool that can do nothing with what it was pointed at; empty: it can.
std::string refusalOf(Tool tool, const Frame& frame, const std::optional<PickHit>& hit) {
  if (!hit || (tool != Tool::drag && tool != Tool::remove && tool != Tool::cut)) return {};
  if (frame.info && frame.info->kind == RunKind::take)
    return "A take is what has happened: open its scene to change things";
  const ListedBody& body = frame.list->bodies[std::size_t(hit->place)];
  if (body.role == BodyRole::ground) return "The ground stays where it is";
  if (tool == Tool::drag && !(body.mass > 0)) return body.name + " is fixed: it cannot be dragged";
  return {};
}

}  // namespace

bool App::takeEvents() {
  SDL_Event event;
  while (SDL_PollEvent(&event)) waiting_.push_back(event);
  bool any = false;
  // Nothing is drawn of a hidden window, so nothing can wait for it.
  while (!waiting_.empty() && (hidden_ || !gui_.mustWait(waiting_.front()))) {
    event = waiting_.front();
    waiting_.pop_front();
    takeEvent(event);
    any = true;
  }
  return any || !waiting_.empty();
}

void App::takeEvent(const SDL_Event& event) {
  const bool ofMouse = event.type >= SDL_MOUSEMOTION && event.type <= SDL_MOUSEWHEEL;
  if (!ofMouse) gui_.take(event);
  switch (event.type) {
    case SDL_QUIT:
      quit_ = true;
      break;
    case SDL_WINDOWEVENT:
      takeWindowEvent(event);
      break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      takeKey(event);
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
    case SDL_MOUSEMOTION:
    case SDL_MOUSEWHEEL:
      takeMouse(event);
      break;
    case SDL_DROPFILE:
      desk_.send(Open{event.drop.file, {}, false});
      SDL_free(event.drop.file);
      break;
    default:
      break;
  }
}

void App::takeWindowEvent(const SDL_Event& event) {
  switch (event.window.event) {
    case SDL_WINDOWEVENT_SIZE_CHANGED:
      desk_.size = {event.window.data1, event.window.data2};
      renderer_.resize(desk_.size);
      gui_.resize(desk_.size);
      report("resized");
      break;
    case SDL_WINDOWEVENT_MINIMIZED:
    case SDL_WINDOWEVENT_HIDDEN:
      hidden_ = true;
      renderer_.setHidden(true);
      report("hidden");
      break;
    case SDL_WINDOWEVENT_RESTORED:
    case SDL_WINDOWEVENT_SHOWN:
    case SDL_WINDOWEVENT_EXPOSED:
      if (hidden_) report("shown");
      hidden_ = false;
      renderer_.setHidden(false);
      break;
    case SDL_WINDOWEVENT_FOCUS_LOST:
      // What was held when the focus went would else be held for ever.
      heldKeys_.clear();
      letGoOf(0);
      break;
    default:
      break;
  }
}

void App::takeKey(const SDL_Event& event) {
  const bool down = event.type == SDL_KEYDOWN;
  const SDL_Keysym& key = event.key.keysym;
  fast_ = (key.mod & KMOD_SHIFT) != 0;
  const char* name = SDL_GetKeyName(key.sym);
  // It may go up with other modifiers than it went down with.
  if (!down) heldKeys_.erase(actionFor(name, false, true));
  if (down && key.sym == SDLK_ESCAPE && (desk_.filesShown || desk_.helpShown)) {
    desk_.filesShown = desk_.helpShown = false;
    return;
  }
  const Action action = actionFor(name, (key.mod & KMOD_CTRL) != 0, fast_);
  if (action == Action::count) return;
  if (bindingOf(action).held) {
    if (!down || !takesCommands()) {
      heldKeys_.erase(action);
    } else {
      heldKeys_.insert(action);
    }
    return;
  }
  if (down && event.key.repeat == 0 && takesCommands()) act(action);
}

bool App::takesCommands() const { return !gui_.wantsKeys() && !desk_.filesShown; }

Ray App::rayAt(double x, double y) const {
  const PixelPlace by = shift();
  return rayThrough(desk_.rig.view(), {desk_.size.width, desk_.size.height}, x - by.x, y - by.y);
}

PixelPlace App::shift() const {
  // Where the panel takes most of the window there is no room to move to.
  if (!desk_.panelShown || desk_.size.width < 2.2 * kPanelWidth) return {};
  return {kPanelWidth / 2, -kBarHeight / 2};
}

// By where the panel lay in the last picture: what ImGui itself says is of where the mouse was then.
bool App::overPanel(int x, int y) const {
  const auto holds = [&](const Place& place) {
    return float(x) >= place.x && float(x) < place.x + place.width && float(y) >= place.y &&
           float(y) < place.y + place.height;
  };
  return gui_.wantsMouse() || std::any_of(desk_.covers.begin(), desk_.covers.end(), holds);
}

void App::letGoOf(std::uint32_t stillHeld) {
  gui_.releaseButtons(stillHeld);
  if (turning_ != 0 && (stillHeld & SDL_BUTTON(turning_)) == 0) turning_ = 0;
  if ((stillHeld & SDL_BUTTON_LMASK) == 0) {
    for (Command& command : desk_.hand.release()) desk_.send(std::move(command));
  }
  sceneHas_ &= stillHeld;
}

void App::takeMouse(const SDL_Event& event) {
  const auto sendAll = [this](std::vector<Command> commands) {
    for (Command& command : commands) desk_.send(std::move(command));
  };
  if (event.type == SDL_MOUSEBUTTONDOWN) {
    if (overPanel(event.button.x, event.button.y)) return gui_.take(event);
    sceneHas_ |= SDL_BUTTON(event.button.button);
    gui_.setMouseAside();
    if (event.button.button == SDL_BUTTON_LEFT) {
      const Ray ray = rayAt(event.button.x, event.button.y);
      std::optional<PickHit> hit;  // shooting needs none
      if (desk_.hand.tool != Tool::shoot) hit = picker_.pick(*frame_, ray, blend_);
      if (const std::string why = refusalOf(desk_.hand.tool, *frame_, hit); !why.empty()) {
        desk_.say(why, false, session_.now());
        return;
      }
      sendAll(desk_.hand.press(ray, desk_.rig.view(), hit));
      if (event.button.clicks == 2 && hit && desk_.hand.tool == Tool::select) {
        Camera there = desk_.rig.asCamera();
        there.target = hit->point;
        desk_.rig.goTo(there);
      }
    } else {
      turning_ = event.button.button;
    }
  } else if (event.type == SDL_MOUSEBUTTONUP) {
    if ((sceneHas_ & SDL_BUTTON(event.button.button)) == 0) return gui_.take(event);
    sceneHas_ &= ~SDL_BUTTON(event.button.button);
    if (event.button.button == SDL_BUTTON_LEFT) sendAll(desk_.hand.release());
    if (int(event.button.button) == turning_) turning_ = 0;
  } else if (event.type == SDL_MOUSEMOTION) {
    // SDL misses what is let go outside of the window, and reports the button held for ever: the display knows.
    if (sceneHas_ != 0 || event.motion.state != 0) letGoOf(SDL_GetGlobalMouseState(nullptr, nullptr));
    if (sceneHas_ == 0) gui_.take(event);
    if (desk_.hand.dragging()) sendAll(desk_.hand.move(rayAt(event.motion.x, event.motion.y), desk_.rig.view()));
    if (turning_ == SDL_BUTTON_RIGHT) {
      desk_.rig.turn(event.motion.xrel * kTurnPerPixel, -event.motion.yrel * kTurnPerPixel);
    } else if (turning_ == SDL_BUTTON_MIDDLE) {
      desk_.rig.drag(event.motion.xrel, event.motion.yrel, {desk_.size.width, desk_.size.height});
    }
  } else if (event.type == SDL_MOUSEWHEEL) {
    int x = 0, y = 0;
    SDL_GetMouseState(&x, &y);
    if (overPanel(x, y)) return gui_.take(event);
    if (desk_.hand.dragging()) {
      sendAll(desk_.hand.wheel(event.wheel.y, rayAt(x, y), desk_.rig.view()));
    } else {
      desk_.rig.zoom(event.wheel.y);
    }
  }
}

void App::moveCamera(double seconds) {
  const auto axis = [this](Action plus, Action minus) {
    return double(heldKeys_.count(plus)) - double(heldKeys_.count(minus));
  };
  const Vec3 keys{axis(Action::right, Action::left), axis(Action::up, Action::down),
                  axis(Action::forward, Action::back)};
  if (keys != Vec3{}) desk_.rig.move(keys * (fast_ ? 3.0 : 1.0), seconds);
  const double right = axis(Action::turnRight, Action::turnLeft), up = axis(Action::turnUp, Action::turnDown);
  if (right != 0 || up != 0) desk_.rig.turn(right * kTurnPerSecond * seconds, up * kTurnPerSecond * seconds);
  std::optional<Vec3> target;
  if (desk_.rig.followed() != 0 && frame_->list) {
    const int place = frame_->list->find(desk_.rig.followed());
    if (place >= 0) target = poseAt(frame_->bodies[std::size_t(place)], blend_).position;
  }
  desk_.rig.update(seconds, target);
}

}  // namespace brickfall::viewer
