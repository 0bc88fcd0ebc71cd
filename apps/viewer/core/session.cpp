// The simulation thread: commands, then the steps that are due, then a frame.
#include "viewer_core/session.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "viewer_core/frame_maker.h"
#include "viewer_core/opening.h"
#include "viewer_core/pace.h"
#include "viewer_core/take_player.h"

namespace brickfall::viewer {

namespace {

constexpr double kLongestBatch = 1.0 / 50;   // s: steps made in a row before a frame and the next commands
constexpr double kShortestWait = 1.0 / 250;  // s: more frames than that nobody sees
constexpr double kLongestBlend = 0.25;       // s: slower than that it is no motion any more
constexpr int kMostSteps = 1000;             // of one command

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Error nothingOpen(const Command& command) {
  return {ErrorCode::wrongState, std::string(nameOf(command)) + ": no scene or take is open"};
}

std::shared_ptr<const RunInfo> watching(RunInfo info, const std::string& path) {
  std::error_code problem;
  info.watched = std::filesystem::is_regular_file(path, problem) ? path : std::string();
  return std::make_shared<const RunInfo>(std::move(info));
}

}  // namespace

class Session::Impl {
 public:
  explicit Impl(SessionOptions given) : options(std::move(given)) {
    if (!options.clock) options.clock = steadySeconds;
    auto empty = std::make_shared<RunInfo>();
    empty->cameras.clear();
    info_ = std::move(empty);
    publish();
    if (options.ownThread) thread_ = std::thread([this] { work(); });
  }

  ~Impl() { (void)finish().ok(); }

  Status finish() {
    {
      std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
    if (!live_) return {};
    Status done;
    std::vector<Sent> late;
    takeSent(late);
    for (const Sent& sent : late)
      if (std::holds_alternative<SaveState>(sent.command))
        if (const CommandResult saved = perform(sent); !saved.ok) done = Error{saved.code, saved.message};
    const Result<std::string> stopped = live_->stopRecording();
    return stopped ? done : Status(stopped.error());
  }

  std::uint64_t send(Command command) {
    std::uint64_t ticket = 0;
    {
      std::lock_guard lock(mutex_);
      ticket = nextTicket_++;
      queue_.push_back({ticket, std::move(command)});
    }
    wake_.notify_all();
    return ticket;
  }

  std::vector<CommandResult> takeResults() {
    std::lock_guard lock(mutex_);
    return std::exchange(results_, {});
  }

  void ask(const FrameNeeds& needs) {
    {
      std::lock_guard lock(mutex_);
      if (needs == needs_) return;
      needs_ = needs;
      asked_ = true;
    }
    wake_.notify_all();
  }

  // Held for as long as a pointer takes to copy.
  std::shared_ptr<const Frame> latest() const {
    std::lock_guard lock(frameMutex_);
    return frame_;
  }

  double pump();
  SessionOptions options;

 private:
  struct Sent {
    std::uint64_t ticket = 0;
    Command command;
  };

  void work();
  bool takeSent(std::vector<Sent>& sent);
  CommandResult perform(const Sent& sent);
  Result<std::string> tryOut(const Command& command, std::vector<std::string>& details);
  Result<std::string> carryOut(const Command& command, std::vector<std::string>& details);
  Result<std::string> open(const Open& open, std::vector<std::string>& details);
  Result<std::string> show(OpenedFile& file);
  Result<std::string> restart(const Restart& restart, std::vector<std::string>& details);
  void endRun();
  Result<std::string> step(int count);
  void setRunning(bool running);
  bool makeSteps(double now);
  bool goOn();
  void stopped(const Error& error);
  void tell(const Error& error);
  void tellProblems();
  double dt() const { return live_ ? live_->run().scene().timeStep : take_ ? take_->dt() : 1; }
  double simulated() const { return live_ ? live_->run().time() : take_ ? take_->time() : 0; }
  void publish();
  void fillStatus(RunStatus& status) const;
  void jump();

  // --- Of both threads.
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Sent> queue_;
  std::vector<CommandResult> results_;
  std::uint64_t nextTicket_ = 1;
  FrameNeeds needs_;
  bool asked_ = false, stop_ = false;
  mutable std::mutex frameMutex_;
  std::shared_ptr<const Frame> frame_;
  std::thread thread_;

  // --- Of the thread that pumps.
  std::unique_ptr<LiveRun> live_;
  std::unique_ptr<TakePlayer> take_;
  std::shared_ptr<const RunInfo> info_;
  FrameMaker maker_;
  Pace pace_;
  EventLog log_;
  Serial nextSerial_ = 1, selected_ = 0;
  std::string loading_;
  std::uint64_t frames_ = 0, carriedOut_ = 0;
  double shownTime_ = 0, shownAt_ = 0;  // simulated time of the last frame; when it was made
  bool jumped_ = true;
};

void Session::Impl::work() {
  while (true) {
    const double wait = std::max(kShortestWait, std::min(3600.0, pump()));
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, std::chrono::duration<double>(wait), [this] { return stop_ || asked_ || !queue_.empty(); });
    if (stop_) return;
  }
}

bool Session::Impl::takeSent(std::vector<Sent>& sent) {
  std::lock_guard lock(mutex_);
  sent = std::exchange(queue_, {});
  return std::exchange(asked_, false);
}

double Session::Impl::pump() {
  std::vector<Sent> sent;
  bool changed = takeSent(sent);
  for (const Sent& one : sent) {
    CommandResult result = perform(one);
    carriedOut_ = one.ticket;
    {
      std::lock_guard lock(mutex_);
      results_.push_back(std::move(result));
    }
    tellProblems();
  }
  changed = changed || !sent.empty();
  const bool stepped = goOn();
  tellProblems();
  // While it runs a change is shown with the next step: a frame between would cut short the way there.
  if (stepped || jumped_ || (changed && !pace_.running())) publish();
  if (!pace_.running()) return 1e9;
  return pace_.wait(options.clock(), dt());
}

// Memory that runs out must not end the program: what is unsaved elsewhere would go with it.
bool Session::Impl::goOn() {
  try {
    return makeSteps(options.clock());
  } catch (const std::exception& error) {
    stopped({ErrorCode::wrongState,
             std::string("a step: ") + error.what() + "; the run is paused, rewind it or start it again"});
    return true;
  }
}

bool Session::Impl::makeSteps(double now) {
  if (!live_ && !take_) return false;
  bool any = false;
  pace_.goOn(now);
  while (pace_.due(dt())) {
    const double step = dt();
    const Status fine = live_ ? live_->step() : take_->step(1, &log_);
    any = true;
    pace_.made(step, options.clock());
    if (!fine) stopped(fine.error());
    if (take_ && take_->atEnd()) setRunning(false);
    if (options.clock() - now > kLongestBatch) break;
  }
  pace_.letGo(options.clock(), dt());
  return any;
}

void Session::Impl::stopped(const Error& error) {
  setRunning(false);
  tell(error);
}

// A mistake that no command answers for.
void Session::Impl::tell(const Error& error) {
  log_.add(simulated(), LogKind::error, error.message);
  CommandResult result;
  result.ok = false;
  result.code = error.code;
  result.message = error.message;
  std::lock_guard lock(mutex_);
  results_.push_back(std::move(result));
}

void Session::Impl::tellProblems() {
  if (!live_) return;
  for (std::string& problem : live_->takeProblems()) tell({ErrorCode::inputOutput, std::move(problem)});
}

void Session::Impl::setRunning(bool running) {
  if (running)
    pace_.run(options.clock());
  else
    pace_.pause();
}

// The next frame is not reached by moving there.
void Session::Impl::jump() {
  jumped_ = true;
  maker_.jump();
  if (take_) take_->jump();
}

// --- Commands.

CommandResult Session::Impl::perform(const Sent& sent) {
  CommandResult result;
  result.ticket = sent.ticket;
  const Result<std::string> answer = tryOut(sent.command, result.details);
  result.ok = answer.ok();
  result.code = answer ? ErrorCode::none : answer.error().code;
  result.message = answer ? *answer : answer.error().message;
  if (!answer) log_.add(simulated(), LogKind::error, result.message);
  return result;
}

Result<std::string> Session::Impl::tryOut(const Command& command, std::vector<std::string>& details) {
  try {
    return carryOut(command, details);
  } catch (const std::exception& error) {
    loading_.clear();
    return Error{ErrorCode::wrongState, std::string(nameOf(command)) + ": " + error.what()};
  }
}

Result<std::string> Session::Impl::carryOut(const Command& command, std::vector<std::string>& details) {
  if (const auto* c = std::get_if<Open>(&command)) return open(*c, details);
  if (!live_ && !take_) return nothingOpen(command);
  if (const auto* c = std::get_if<Restart>(&command)) return restart(*c, details);
  if (std::holds_alternative<Run>(command)) {
    if (take_ && take_->atEnd()) {
      if (Status there = take_->seek(take_->firstTime()); !there) return there.error();
      jump();
    }
    setRunning(true);
    return std::string();
  }
  if (std::holds_alternative<Pause>(command)) {
    setRunning(false);
    return std::string();
  }
  if (const auto* c = std::get_if<Step>(&command)) return step(c->count);
  if (const auto* c = std::get_if<SetSpeed>(&command)) {
    if (!(c->factor >= kSlowest && c->factor <= kFastest))
      return Error{ErrorCode::invalidArgument, "speed: found " + shortNumber(c->factor) + ", expected " +
                                                   shortNumber(kSlowest) + " .. " + shortNumber(kFastest)};
    pace_.setSpeed(c->factor);
    return std::string();
  }
  if (const auto* c = std::get_if<Select>(&command)) {
    selected_ = c->body;
    return std::string();
  }
  const bool back = std::holds_alternative<Rewind>(command);
  if (back || std::holds_alternative<Undo>(command)) jump();
  if (back) setRunning(false);
  if (live_) return live_->execute(command);
  if (!back)
    return Error{ErrorCode::wrongState, std::string(nameOf(command)) + ": a take is played, this needs a scene"};
  if (Status there = take_->seek(std::get<Rewind>(command).time); !there) return there.error();
  return std::string();
}

Result<std::string> Session::Impl::step(int count) {
  if (count == 0 || count > kMostSteps || count < -kMostSteps)
    return Error{ErrorCode::invalidArgument, "step: found " + std::to_string(count) + " steps, expected 1 .. " +
                                                 std::to_string(kMostSteps) + " or as many back"};
  setRunning(false);
  if (count < 0) jump();
  if (take_) {
    if (Status there = take_->step(count, &log_); !there) return there.error();
    return std::string();
  }
  if (count < 0) return live_->stepBack(-count);
  for (int i = 0; i < count; i++)
    if (Status fine = live_->step(); !fine) return fine.error();
  return std::string();
}

// What is shown stays until the new one is there.
Result<std::string> Session::Impl::open(const Open& open, std::vector<std::string>& details) {
  loading_ = open.nameOrPath;
  publish();
  OpenedFile file = open.read ? std::move(*open.read) : readOpening(open.nameOrPath, open.overrides);
  for (const Diagnostic& diagnostic : file.opening.diagnostics) details.push_back(format(diagnostic));
  Result<std::string> answer = show(file);
  loading_.clear();
  jumped_ = true;
  if (!answer) return answer;
  for (const Diagnostic& d : file.opening.diagnostics) log_.add(0, LogKind::warning, format(d));
  setRunning(open.run);
  return answer;
}

Result<std::string> Session::Impl::show(OpenedFile& file) {
  if (file.opening.exitCode != 0 && file.opening.problem.empty())
    return Error{ErrorCode::badFormat,
                 file.opening.diagnostics.empty() ? "the scene is wrong" : format(file.opening.diagnostics.front())};
  if (file.opening.exitCode != 0)
    return Error{file.opening.exitCode == 3 ? ErrorCode::inputOutput : ErrorCode::badFormat, file.opening.problem};
  if (file.take) {
    Result<std::unique_ptr<TakePlayer>> take = TakePlayer::start(std::move(*file.take), file.opening.path, nextSerial_);
    if (!take) return take.error();
    endRun();
    take_ = std::move(*take);
    info_ = watching(*take_->info(), file.opening.path);
  } else {
    const bool saved = file.opening.kind == OpeningKind::state;
    Result<std::unique_ptr<LiveRun>> run =
        saved ? LiveRun::resume({file.source, file.settings, std::move(file.snapshot)}, *file.scene, options.history,
                                nextSerial_, log_)
              : LiveRun::start(file.source, *file.scene, options.history, nextSerial_, log_);
    if (!run) return run.error();
    endRun();
    take_.reset();
    live_ = std::move(*run);
    info_ = watching(*infoOf(live_->run()), saved ? std::string() : file.opening.path);
  }
  maker_ = FrameMaker();
  selected_ = 0;
  jump();
  std::string told = "opened " + std::filesystem::path(file.opening.path).filename().string();
  log_.add(simulated(), LogKind::note, told);
  return told;
}

void Session::Impl::endRun() {
  if (live_) live_->endRecording();
  tellProblems();
  live_.reset();
}

Result<std::string> Session::Impl::restart(const Restart& restart, std::vector<std::string>& details) {
  jump();
  if (take_) {
    if (Status there = take_->seek(take_->firstTime()); !there) return there.error();
    return std::string();
  }
  SceneSource source = live_->source();
  SceneDescription scene = live_->wanted();
  if (restart.asInFile) {
    OpenedFile file = readAgain(source);
    for (const Diagnostic& diagnostic : file.opening.diagnostics) details.push_back(format(diagnostic));
    if (!file.scene) return Error{ErrorCode::badFormat, details.empty() ? "the scene is wrong" : details.front()};
    source = std::move(file.source);
    scene = std::move(*file.scene);
  }
  Result<std::unique_ptr<LiveRun>> run = LiveRun::start(source, scene, options.history, nextSerial_, log_);
  if (!run) return run.error();
  endRun();
  live_ = std::move(*run);
  // The window looks on from where it was, unless it is another scene now.
  if (restart.asInFile || info_->reportMethod != (scene.method == SceneMethod::report))
    info_ = watching(*infoOf(live_->run()), info_->watched);
  maker_ = FrameMaker();
  selected_ = 0;
  log_.add(0, LogKind::note, "from the beginning");
  return std::string();
}

// --- Frames.

void Session::Impl::fillStatus(RunStatus& status) const {
  status.running = pace_.running();
  status.speed = pace_.speed();
  status.reachedSpeed = pace_.reached(options.clock());
  status.loading = loading_;
  status.time = simulated();
  if (take_) {
    status.step = take_->frame();
    status.earliest = take_->firstTime();
    status.latest = take_->lastTime();
  }
  if (!live_) return;
  status.step = live_->run().stepCount();
  status.recording = live_->recording();
  status.earliest = live_->history().earliest();
  status.latest = live_->history().latest();
  status.historyBytes = live_->history().bytes();
  status.undo = live_->undoLabel();
  status.settingsWait = live_->settingsWait();
}

void Session::Impl::publish() {
  FrameNeeds needs;
  {
    std::lock_guard lock(mutex_);
    needs = needs_;
  }
  auto frame = std::make_shared<Frame>();
  frame->number = ++frames_;
  frame->carriedOut = carriedOut_;
  frame->info = info_;
  frame->list = std::make_shared<BodyList>();
  fillStatus(frame->status);
  if (live_) maker_.fill(*frame, *live_, needs, selected_);
  if (take_) take_->fill(*frame, needs, selected_);
  frame->info = info_;
  frame->log = log_.lines();
  frame->madeAt = options.clock();
  // Slower than asked for: the way to the new poses takes as long as the next ones will.
  const double span = simulated() - shownTime_;
  if (!jumped_ && span > 0)
    frame->shownFor =
        std::min(kLongestBlend, std::max(span / pace_.speed(), pace_.running() ? frame->madeAt - shownAt_ : 0));
  shownTime_ = simulated();
  shownAt_ = frame->madeAt;
  jumped_ = false;
  std::shared_ptr<const Frame> old = std::move(frame);
  std::lock_guard lock(frameMutex_);
  frame_.swap(old);  // the old one is freed after the lock
}

Session::Session(SessionOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Session::~Session() = default;
std::uint64_t Session::send(Command command) { return impl_->send(std::move(command)); }
std::vector<CommandResult> Session::takeResults() { return impl_->takeResults(); }
std::shared_ptr<const Frame> Session::latest() const { return impl_->latest(); }
void Session::ask(const FrameNeeds& needs) { impl_->ask(needs); }
double Session::now() const { return impl_->options.clock(); }
Status Session::finish() { return impl_->finish(); }
double Session::pump() { return impl_->pump(); }

}  // namespace brickfall::viewer
