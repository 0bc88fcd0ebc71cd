// What lies before the user: everything that the keys, the mouse and the panel change, in one place. The panel reads it and the
// frame, and changes nothing else; commands to the run wait in it until the picture is finished.
#pragma once
#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "viewer_core/camera_rig.h"
#include "viewer_core/commands.h"
#include "viewer_core/file_list.h"
#include "viewer_core/key_bindings.h"
#include "viewer_core/scene_menu.h"
#include "viewer_core/tools.h"
#include "viewer_window/renderer.h"
#include "viewer_window/view_options.h"

namespace brickfall::viewer {

// Shown over the picture for some seconds, one at a time; errors stay until they are closed.
struct Message {
  std::string text;
  std::vector<std::string> details;
  bool error = false;
  double until = 0;  // s of the window's clock
};

// Where a part of the panel is, in pixels; for tests that press it.
struct Place {
  float x = 0, y = 0, width = 0, height = 0;
};

struct Desk {
  ViewOptions view;
  Hand hand;
  CameraRig rig;
  bool panelShown = true, helpShown = false,
       figuresShown = false;        // figuresShown: the tab is open, so plots are gathered
  std::string statePath, takePath;  // what is typed into the fields
  bool filesShown = false;          // the list of files that can be opened
  bool filesAsked = false;          // it is to be made anew
  bool awaitsText = false;          // a field is about to have the cursor
  std::vector<FileEntry> files;
  std::string filesTyped;
  int filesChosen = 0;  // of those that fit what is typed
  std::vector<MenuGroup> menu;
  std::vector<Message> messages;
  std::vector<Command> commands;  // to be sent
  std::vector<Action> actions;    // pressed in the panel; done as if their key had been pressed
  std::map<std::string, Place> places;
  std::vector<Place> covers;  // what the panel's windows cover

  // About the drawing, for the panel.
  WindowSize size;
  PixelPlace shift;        // of the view's middle: the panel covers a part of the window
  bool unsettled = false;  // the panel is not laid out as it will be: another picture is wanted
  bool resting = false;    // nothing changes, so nothing is drawn
  ShadowMode shadows = ShadowMode::none;
  std::string card;
  double framesPerSecond = 0;
  double drawMilliseconds = 0;

  void send(Command command) { commands.push_back(std::move(command)); }
  void say(std::string text, bool error, double now, std::vector<std::string> details = {});
};

}  // namespace brickfall::viewer
