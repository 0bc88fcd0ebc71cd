// What each action of the table of keys does.
#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "brickfall/whole_file.h"
#include "viewer_core/scene_text.h"
#include "viewer_window/app.h"
#include "viewer_window/still.h"

namespace brickfall::viewer {

void App::act(Action action) {
  if (!actOnTime(action) && !actOnHands(action) && !actOnCamera(action) && !actOnView(action)) actOnFiles(action);
  report("action");
}

bool App::actOnTime(Action action) {
  const RunStatus& status = frame_->status;
  const bool running = asked_.running.value_or(status.running);
  const double speed = asked_.speed.value_or(status.speed), time = asked_.time.value_or(status.time);
  const auto ask = [this](auto& what, auto value) {
    what = value;
    asked_.any = true;
    asked_.ticket = 0;
  };
  const auto setSpeed = [&](double wanted) {
    ask(asked_.speed, wanted);
    desk_.send(SetSpeed{wanted});
  };
  switch (action) {
    case Action::runOrPause:
      ask(asked_.running, !running);
      if (running) {
        desk_.send(Pause{});
      } else {
        desk_.send(Run{});
      }
      return true;
    case Action::step:
    case Action::stepBack:
      ask(asked_.running, false);
      desk_.send(Step{action == Action::step ? 1 : -1});
      return true;
    case Action::slower:
      setSpeed(std::max(kSlowest, speed / 2));
      return true;
    case Action::faster:
      setSpeed(std::min(kFastest, speed * 2));
      return true;
    case Action::normalSpeed:
      setSpeed(1);
      return true;
    case Action::restart:
      desk_.send(Restart{});
      return true;
    case Action::undo:
      desk_.send(Undo{});
      return true;
    case Action::rewindSecond:
      goTo(time - 1);
      return true;
    case Action::forwardSecond:
      goTo(time + 1);
      return true;
    case Action::toBeginning:
      goTo(status.earliest);
      return true;
    case Action::toEnd:
      goTo(status.latest);
      return true;
    default:
      return false;
  }
}

void App::goTo(double time) {
  const double there =
      std::clamp(time, frame_->status.earliest, std::max(frame_->status.earliest, frame_->status.latest));
  asked_.time = there;
  asked_.running = false;
  asked_.any = true;
  asked_.ticket = 0;
  desk_.send(Rewind{there});
}

bool App::actOnHands(Action action) {
  ToolSettings& settings = desk_.hand.settings;
  switch (action) {
    case Action::selectTool:
      desk_.hand.tool = Tool::select;
      return true;
    case Action::shootTool:
      desk_.hand.tool = Tool::shoot;
      return true;
    case Action::dragTool:
      desk_.hand.tool = Tool::drag;
      return true;
    case Action::removeTool:
      desk_.hand.tool = Tool::remove;
      return true;
    case Action::blastTool:
      desk_.hand.tool = Tool::blast;
      return true;
    case Action::cutTool:
      desk_.hand.tool = Tool::cut;
      return true;
    case Action::tiltLeft:
    case Action::tiltRight:
      desk_.send(desk_.hand.tilt(desk_.rig.view(), action == Action::tiltLeft ? 1 : -1));
      return true;
    case Action::jerkGround:
      desk_.send(desk_.hand.jerk(desk_.rig.view()));
      return true;
    case Action::shootCentre:
      desk_.send(desk_.hand.shot(rayAt(desk_.size.width / 2.0 + shift().x, desk_.size.height / 2.0 + shift().y)));
      return true;
    case Action::removeSelected:
      if (const int place = frame_->list->find(selected()); place >= 0) {
        if (frame_->list->bodies[std::size_t(place)].role == BodyRole::ground) {
          desk_.say("The ground stays where it is", false, session_.now());
        } else {
          desk_.send(RemoveBody{selected()});
        }
      }
      return true;
    case Action::letGo:
      desk_.send(Select{0});
      return true;
    case Action::wakeAll:
      desk_.send(WakeBody{0});
      return true;
    case Action::smallerBall:
    case Action::largerBall:
      growBall(settings, action == Action::largerBall ? 1.25 : 0.8);
      return true;
    case Action::slowerBall:
    case Action::fasterBall:
      hastenBall(settings, action == Action::fasterBall ? 1.25 : 0.8);
      return true;
    default:
      return false;
  }
}

bool App::actOnCamera(Action action) {
  switch (action) {
    case Action::orbitCamera:
      desk_.rig.setMode(CameraMode::orbit);
      return true;
    case Action::flyCamera:
      desk_.rig.setMode(CameraMode::fly);
      return true;
    case Action::followSelected: {
      const int place = frame_->list->find(selected());
      if (place >= 0) {
        desk_.rig.follow(selected(), frame_->list->bodies[std::size_t(place)].radius);
      } else {
        desk_.say("Select a body first: the camera then follows it", false, session_.now());
      }
      return true;
    }
    case Action::frameAll:
      if (run_) desk_.rig.frame(run_->extent, {desk_.size.width, desk_.size.height});
      return true;
    case Action::nextView:
      if (run_ && !run_->cameras.empty())
        desk_.rig.goTo(run_->cameras[nextCamera_++ % run_->cameras.size()], false, frame_->list.get());
      return true;
    default:
      return false;
  }
}

bool App::actOnView(Action action) {
  ViewOptions& view = desk_.view;
  const auto flip = [](bool& value) { value = !value; };
  switch (action) {
    case Action::collisions:
      flip(view.collisions);
      return true;
    case Action::wireframe:
      flip(view.wireframe);
      return true;
    case Action::colliders:
      flip(view.colliders);
      return true;
    case Action::boundsTree:
      flip(view.bounds);
      return true;
    case Action::contactPoints:
      flip(view.contacts);
      return true;
    case Action::islands:
      flip(view.islands);
      return true;
    case Action::asleep:
      flip(view.asleep);
      return true;
    case Action::shadows:
      view.shadows = ShadowChoice((int(view.shadows) + 1) % kShadowChoiceCount);
      desk_.say(fmt::format("Shadows: {}", nameOf(view.shadows)), false, session_.now());
      return true;
    case Action::mortar:
      view.mortar = MortarView((int(view.mortar) + 1) % kMortarViewCount);
      return true;
    case Action::panel:
      flip(desk_.panelShown);
      return true;
    case Action::help:
      flip(desk_.helpShown);
      return true;
    case Action::fullScreen:
      window_.setFullScreen(!window_.fullScreen());
      return true;
    default:
      return false;
  }
}

void App::actOnFiles(Action action) {
  switch (action) {
    case Action::openScene:
      openFiles();
      break;
    case Action::saveScene:
      saveSceneFile();
      break;
    case Action::saveState:
      desk_.send(SaveState{desk_.statePath});
      break;
    case Action::loadState:
      desk_.send(Open{desk_.statePath, {}, false});
      break;
    case Action::record:
      asked_.recording = !asked_.recording.value_or(!frame_->status.recording.empty());
      asked_.any = true;
      asked_.ticket = 0;
      if (*asked_.recording) {
        desk_.send(StartRecording{desk_.takePath});
      } else {
        desk_.send(StopRecording{});
      }
      break;
    case Action::saveStill:
      saveScene();
      break;
    case Action::copyView: {
      const Camera camera = desk_.rig.asCamera();
      const std::string text = fmt::format(
          "[[camera]]\nname = \"view\"\nposition = [{:.3f}, {:.3f}, {:.3f}]\ntarget = [{:.3f}, {:.3f}, {:.3f}]\n"
          "field_of_view_degrees = {:g}\n",
          camera.position.x, camera.position.y, camera.position.z, camera.target.x, camera.target.y, camera.target.z,
          camera.fieldOfViewDegrees);
      SDL_SetClipboardText(text.c_str());
      desk_.say("This view is in the clipboard, as a scene file has it", false, session_.now());
      break;
    }
    case Action::quit:
      quit_ = true;
      break;
    default:
      break;
  }
}

// With the cursor in it: what is typed from now on is a name.
void App::openFiles() {
  desk_.filesShown = desk_.filesAsked = true;
  desk_.files = findFiles(".", recentFiles());
  heldKeys_.clear();
  gui_.awaitText();
}

void App::saveSceneFile() {
  if (!run_ || run_->kind == RunKind::nothing) return;
  std::string path;
  std::error_code problem;
  for (int number = 1; path.empty() || std::filesystem::exists(path, problem); number++)
    path = fmt::format("{}-{}.toml", run_->name, number);
  const SceneText scene = sceneTextOf(*frame_, desk_.rig.asCamera());
  const Status saved = writeWhole(path, scene.text);
  std::string told = "Saved " + path;
  if (!scene.leftOut.empty()) told += ", without " + scene.leftOut;
  desk_.say(saved ? told : saved.error().message, !saved, session_.now());
}

// The scene alone: a picture is drawn without the panel for it.
void App::saveScene() {
  gui_.setVisible(false);
  renderer_.render();
  const Picture picture = renderer_.picture();
  gui_.setVisible(true);
  const std::string path = freeStillName(run_ ? run_->name : "");
  const Status saved = saveStill(picture, path);
  desk_.say(saved ? "Saved " + path : saved.error().message, !saved, session_.now());
}

}  // namespace brickfall::viewer
