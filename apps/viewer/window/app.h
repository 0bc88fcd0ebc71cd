// The viewer as a whole: events go in, commands to the run and pictures come out.
#pragma once
#include <SDL_events.h>

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer_core/picking.h"
#include "viewer_core/session.h"
#include "viewer_window/body_drawer.h"
#include "viewer_window/debug_layers.h"
#include "viewer_window/desk.h"
#include "viewer_window/dust.h"
#include "viewer_window/gui.h"
#include "viewer_window/lines.h"
#include "viewer_window/native_window.h"
#include "viewer_window/options.h"
#include "viewer_window/renderer.h"
#include "viewer_window/sky.h"
#include "viewer_window/status_file.h"

namespace brickfall::viewer {

class App {
 public:
  // The session is there before the window, so that the scene is read while the window opens.
  // `opens`: ticket of what the command line asked to open.
  App(const Options& options, Session& session, NativeWindow& window, Renderer& renderer, StatusFile& status,
      std::uint64_t opens);
  ~App();
  // Until the user quits, or as long as the options say. An exit code of docs/command-line.md.
  int run();

 private:
  // --- app_input.cpp
  bool takeEvents();  // true: something happened
  void takeEvent(const SDL_Event& event);
  void takeWindowEvent(const SDL_Event& event);
  void takeKey(const SDL_Event& event);
  void takeMouse(const SDL_Event& event);
  void letGoOf(std::uint32_t stillHeld);  // what was let go where nobody told us: outside of the window
  bool takesCommands() const;             // no text is being typed
  bool overPanel(int x, int y) const;
  void moveCamera(double seconds);
  Ray rayAt(double x, double y) const;  // pixels of the window
  PixelPlace shift() const;             // of the view's middle: the panel covers a part of the window
  // --- app_actions.cpp
  void act(Action action);
  bool actOnTime(Action action);
  void goTo(double time);
  void openFiles();
  void saveSceneFile();
  bool actOnHands(Action action);
  bool actOnCamera(Action action);
  bool actOnView(Action action);
  void actOnFiles(Action action);
  void saveScene();
  // --- app.cpp
  void takeFrame();
  void startOf(const RunInfo& info);
  void takeResults();
  void sendCommands();
  void draw(double seconds);
  void keepCount();
  void watchFile();
  bool changing(bool busy) const;
  void waitForNext(double began, bool busy, bool draws);
  bool finished() const;
  int end();
  Serial selected() const { return frame_->selected ? frame_->selected->serial : 0; }
  void report(const std::string& why);  // once the next picture shows it
  void writeReports();

  const Options& options_;
  Session& session_;
  NativeWindow& window_;
  Renderer& renderer_;
  StatusFile& status_;
  Sky sky_;
  BodyDrawer bodies_;
  Lines lines_;
  DebugLayers layers_;
  Dust dust_;
  Gui gui_;
  Picker picker_;
  Desk desk_;
  std::shared_ptr<const Frame> frame_;
  std::shared_ptr<const RunInfo> run_;
  double blend_ = 1;
  std::map<std::uint64_t, std::string> sent_;  // what each ticket was for
  // Asked for, and in no frame yet: the next request is reckoned from it.
  struct Asked {
    std::optional<bool> running, recording;
    std::optional<double> speed, time;
    std::uint64_t ticket = 0;  // of the last command; 0: it is still to be sent
    bool any = false;
  } asked_;
  std::deque<SDL_Event> waiting_;  // events, until a picture has shown those before them
  std::set<Action> heldKeys_;
  bool fast_ = false;           // Shift, for held keys
  int turning_ = 0;             // mouse button that turns (3) or moves (2) the camera
  std::uint32_t sceneHas_ = 0;  // buttons that were pressed on the scene, as SDL's mask
  Vec3 lastView_;
  std::size_t nextCamera_ = 0;
  std::vector<std::string> reports_;
  bool quit_ = false, hidden_ = false, wasDragged_ = false;
  int settling_ = 0;  // pictures still to be drawn since something changed
  double started_ = 0, lastReport_ = 0, countFrom_ = 0, drawn_ = 0;
  struct Watch {
    std::string path;
    std::int64_t shown = 0, seen = 0;  // when it was written: what is shown, and what was seen last
    double lookedAt = 0;
  } watch_;
  std::uint64_t pictures_ = 0, countPictures_ = 0;
  std::uint64_t shown_ = 0;  // pictures of a run
  std::uint64_t opens_ = 0;
  int openingFailed_ = 0;  // exit code, as long as nothing is open; 0: it did not
};

}  // namespace brickfall::viewer
