#include "viewer_window/app.h"

#include <SDL.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "viewer_window/near_plane.h"
#include "viewer_window/panels/panels.h"
#include "viewer_window/still.h"
#include "viewer_window/sun.h"

namespace brickfall::viewer {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;  // where the display does not set the pace
constexpr double kIdleSeconds = 0.1;        // between looks at what may have changed
constexpr double kBlinkSeconds = 0.3;
constexpr double kWatchSeconds = 0.25;        // between looks at the file that is shown
constexpr int kSettlingPictures = 3;          // after the last change: ImGui takes two to show what came of it
constexpr int kBadInput = 2, kFileError = 3;  // of docs/command-line.md

// When a file was written; 0: it is not there.
std::int64_t writtenAt(const std::string& path) {
  std::error_code problem;
  const auto time = std::filesystem::last_write_time(path, problem);
  return problem ? 0 : std::int64_t(time.time_since_epoch().count());
}

}  // namespace

App::App(const Options& options, Session& session, NativeWindow& window, Renderer& renderer, StatusFile& status,
         std::uint64_t opens)
    : options_(options),
      session_(session),
      window_(window),
      renderer_(renderer),
      status_(status),
      sky_(renderer.scene()),
      bodies_(renderer),
      lines_(renderer.scene()),
      dust_(renderer.scene()),
      gui_(renderer.port(), window.size()),
      frame_(session.latest()),
      opens_(opens) {
  desk_.view.shadows = options.shadows;
  desk_.panelShown = options.panel;
  desk_.size = window.size();
  desk_.card = renderer.card().substr(0, renderer.card().find(" ("));
  desk_.menu = sceneMenu();
  started_ = lastReport_ = countFrom_ = session_.now();
}

App::~App() = default;

int App::run() {
  double last = session_.now();
  while (!quit_ && !finished()) {
    const double began = session_.now(), seconds = std::min(began - last, 0.25);
    last = began;
    bool busy = takeEvents();
    const std::uint64_t before = frame_->number;
    takeFrame();
    takeResults();
    const Vec3 eye = desk_.rig.view().position, target = desk_.rig.target();
    moveCamera(seconds);
    watchFile();
    busy = changing(busy || frame_->number != before || length(desk_.rig.view().position - eye) > 1e-5 ||
                    length(desk_.rig.target() - target) > 1e-5 || blend_ < 1);
    settling_ = busy ? kSettlingPictures : std::max(0, settling_ - 1);
    const bool draws = !hidden_ && (settling_ > 0 || (options_.frames > 0 && shown_ < options_.frames));
    if (draws) draw(seconds);
    if (!draws && !desk_.resting) report("rest");
    desk_.resting = !draws;
    writeReports();
    sendCommands();
    keepCount();
    waitForNext(began, busy, draws);
  }
  const int code = end();
  report("quit");
  writeReports();
  return code;
}

// What changes without an event or a frame.
bool App::changing(bool busy) const {
  const double now = session_.now();
  const auto over = [now](const Message& message) { return !message.error && now > message.until; };
  return busy || !desk_.actions.empty() || !desk_.commands.empty() || desk_.unsettled ||
         (gui_.wantsKeys() && now - drawn_ > kBlinkSeconds) ||  // the cursor blinks
         std::any_of(desk_.messages.begin(), desk_.messages.end(), over);
}

// A scene that is edited elsewhere begins anew with each version of it, once that has been left alone for a moment.
void App::watchFile() {
  const double now = session_.now();
  if (!run_ || run_->watched.empty() || now - watch_.lookedAt < kWatchSeconds) return;
  watch_.lookedAt = now;
  const std::int64_t written = writtenAt(run_->watched);
  if (watch_.path != run_->watched) {
    watch_ = {run_->watched, written, written, now};
    return;
  }
  const bool still = written == watch_.seen;
  watch_.seen = written;
  if (written == 0 || written == watch_.shown || !still) return;
  watch_.shown = written;
  if (run_->kind == RunKind::take) {
    desk_.send(Open{run_->watched, {}, false});
  } else {
    desk_.send(Restart{true});
  }
  desk_.say(std::filesystem::path(run_->watched).filename().string() + " has changed: read again", false, now);
}

// What fails now has no window left to be told in.
int App::end() {
  if (openingFailed_ != 0) return openingFailed_;
  int code = 0;
  const auto check = [&code](const char* what, const Status& done) {
    if (done) return;
    std::fprintf(stderr, "brickfall-view: %s%s\n", what, done.error().message.c_str());
    code = kFileError;
  };
  check("", session_.finish());
  if (!options_.screenshot.empty()) check("--screenshot: ", saveStill(renderer_.picture(), options_.screenshot));
  return code;
}

bool App::finished() const {
  const bool unattended = options_.frames > 0 || options_.seconds > 0;
  if (unattended && openingFailed_ != 0) return true;
  if (options_.frames > 0 && shown_ >= options_.frames) return true;
  return options_.seconds > 0 && session_.now() - started_ >= options_.seconds;
}

void App::takeFrame() {
  frame_ = session_.latest();
  if (asked_.any && asked_.ticket != 0 && frame_->carriedOut >= asked_.ticket) asked_ = {};
  blend_ = blendAt(*frame_, session_.now());
  if (frame_->info != run_) {
    run_ = frame_->info;
    if (run_ && run_->kind != RunKind::nothing) {
      openingFailed_ = 0;
      startOf(*run_);
    }
  }
  // Not yet is not no longer: the drag is in a frame only some time after it began.
  if (wasDragged_ && !frame_->drag) desk_.hand.letGo();
  wasDragged_ = frame_->drag.has_value();
  session_.ask(desk_.view.needs(desk_.panelShown && desk_.figuresShown));
}

void App::startOf(const RunInfo& info) {
  const bool same = !info.watched.empty() && info.watched == watch_.path;  // it is looked on at from where it was
  if (!info.watched.empty()) rememberFile(info.watched);
  desk_.rig.setGround(info.ground);
  if (!info.cameras.empty()) {
    if (!same) desk_.rig.goTo(info.cameras.front(), true, frame_->list.get());
    const Camera& first = info.cameras.front();
    const Camera start = first.path.empty() ? first : cameraAt(first, first.path.front().time);
    const Vec3 sun = towardsSun(start.position - start.target);
    sky_.setSun(sun);
    bodies_.setSun(sun);
    dust_.setSun(sun);
  }
  nextCamera_ = 1;
  desk_.statePath = info.name + ".state";
  desk_.takePath = info.name + ".take";
  window_.setTitle((info.title.empty() ? info.name : info.title) + " - Brickfall");
}

void App::takeResults() {
  for (CommandResult& result : session_.takeResults()) {
    const auto sent = sent_.find(result.ticket);
    const std::string what = sent != sent_.end() ? sent->second : "";
    if (sent != sent_.end()) sent_.erase(sent);
    if (result.ticket == opens_ && !result.ok) {
      openingFailed_ = result.code == ErrorCode::inputOutput ? kFileError : kBadInput;
      std::fprintf(stderr, "brickfall-view: %s\n", result.message.c_str());
    }
    // Nobody is held then, and what the hand did on the way there is no mistake of its own.
    const bool ofHand = what == nameOf(DragBegin{}) || what == nameOf(DragMove{}) || what == nameOf(DragEnd{});
    if (!result.ok && ofHand) desk_.hand.letGo();
    const bool told = !ofHand || what == nameOf(DragBegin{});
    if (told && (!result.message.empty() || !result.ok)) {
      desk_.say(result.message.empty() ? what + " failed" : result.message, !result.ok && !ofHand, session_.now(),
                std::move(result.details));
    }
    report((result.ok ? "done: " : "refused: ") + what);
  }
}

void App::sendCommands() {
  for (const Action action : std::exchange(desk_.actions, {})) act(action);
  for (Command& command : std::exchange(desk_.commands, {})) {
    const std::string name = nameOf(command);
    const std::uint64_t ticket = session_.send(std::move(command));
    sent_[ticket] = name;
    if (asked_.any) asked_.ticket = ticket;
  }
}

void App::draw(double seconds) {
  const Frame& frame = *frame_;
  const double began = session_.now();
  const View view = desk_.rig.view();
  const bool any = frame.list && !frame.bodies.empty() && frame.info;
  desk_.shift = shift();
  renderer_.setView(view, any ? nearPlaneOf(frame, blend_, view.position) : kLeastNear, shift());
  ShadowMode wanted = ShadowMode::none;
  switch (desk_.view.shadows) {
    case ShadowChoice::stencil:
      wanted = ShadowMode::stencil;
      break;
    case ShadowChoice::depth:
      wanted = ShadowMode::depth;
      break;
    case ShadowChoice::none:
      break;
  }
  if (desk_.view.wireframe) wanted = ShadowMode::none;  // lines have no shadows
  if (wanted != desk_.shadows) bodies_.setShadows(desk_.shadows = wanted);
  renderer_.setWireframe(desk_.view.wireframe);
  sky_.setVisible(!desk_.view.wireframe);
  lines_.clear();
  if (any) {
    bodies_.draw(frame, blend_, desk_.view, view, selected());
    layers_.addLayers(lines_, frame, blend_, desk_.view);
    layers_.addHands(lines_, frame, blend_, selected());
    dust_.update(frame, view, desk_.view.dust && !desk_.view.wireframe);
  }
  lines_.show();
  desk_.unsettled = false;
  gui_.begin(seconds);
  showPanel(desk_, frame, session_.now());
  gui_.end();
  if (std::exchange(desk_.awaitsText, false)) {
    gui_.awaitText();
    desk_.unsettled = true;
  }
  renderer_.render();
  pictures_++;
  drawn_ = session_.now();
  shown_ += run_ && run_->kind != RunKind::nothing;
  report("picture");
  desk_.drawMilliseconds += 0.1 * (1000 * (session_.now() - began) - desk_.drawMilliseconds);
}

void App::keepCount() {
  const double now = session_.now();
  countPictures_++;
  if (now - countFrom_ >= 0.5) {
    desk_.framesPerSecond = double(countPictures_) / (now - countFrom_);
    countFrom_ = now;
    countPictures_ = 0;
  }
  if (now - lastReport_ >= 1) {
    report("second");
    lastReport_ = now;
  }
}

void App::waitForNext(double began, bool busy, bool draws) {
  if (shown_ > 0 && options_.frames > 0 && !hidden_) return;  // as fast as it goes
  // An answer that is on its way is looked for often.
  const double wanted = draws || busy || (!sent_.empty() && !hidden_) ? kFrameSeconds : kIdleSeconds;
  const double left = wanted - (session_.now() - began);
  if (left <= 0) return;
  if (busy && !waiting_.empty()) return;
  if (busy) {
    SDL_Delay(Uint32(left * 1000));
  } else {
    SDL_WaitEventTimeout(nullptr, int(left * 1000));  // what comes ends the wait, and stays in the queue
  }
}

void App::report(const std::string& why) { reports_.push_back(why); }

void App::writeReports() {
  for (const std::string& why : std::exchange(reports_, {})) {
    status_.write(why, desk_, *frame_, pictures_, lines_.count());
  }
}

}  // namespace brickfall::viewer
