#include "viewer_core/live_run.h"

#include <algorithm>

#include "viewer_core/settings_table.h"
#include "viewer_core/shape_facts.h"

namespace brickfall::viewer {

namespace {

constexpr std::size_t kMostHitLines = 3;  // of a step: the strongest
constexpr double kRewindSlack = 0.25;     // steps
constexpr double kMostWork = 400;  // ms: costly steps get snapshots sooner, so that rewinding makes few of them again

}  // namespace

ListedBody listed(const SceneRun& run, BodyId id, Serial serial) {
  ListedBody body;
  body.serial = serial;
  body.id = id;
  body.number = id.index - 1;
  for (ShapeId shape : run.world().shapes(id)) body.shapes.push_back(*run.world().shape(shape));
  body.radius = radiusOf(body.shapes);
  const PlacedBody* placed = run.find(id);
  // Of a body that is still held the world knows no mass: its own is that of its shapes.
  const bool moves = placed ? placed->def.type == BodyType::dynamic : run.world().state(id)->mass > 0;
  if (moves) body.mass = run.world().massProperties(id)->mass;
  body.name = placed ? placed->name : "body " + std::to_string(id.index);
  if (!placed) return body;
  body.role = placed->role;
  body.colour = placed->colour;
  if (!placed->materials.empty()) body.material = placed->materials.front();
  if (placed->materials.size() > 1) body.drawnMaterials = placed->materials;
  if (const DrawnBody* drawn = run.drawn(id)) {
    body.drawn = drawn->shapes;
    body.drawnMaterials = drawn->materials;
  }
  if (!body.drawnMaterials.empty()) body.drawnColours = run.colours(id);
  return body;
}

LiveRun::LiveRun(SceneSource source, SceneDescription scene, SceneRun run, const HistoryLimits& limits,
                 Serial& nextSerial, EventLog& log)
    : source_(std::move(source)),
      wanted_(std::move(scene)),
      run_(std::move(run)),
      history_(limits),
      nextSerial_(&nextSerial),
      log_(&log) {
  takeSettings();
  begin();
}

Result<std::unique_ptr<LiveRun>> LiveRun::start(const SceneSource& source, const SceneDescription& scene,
                                                const HistoryLimits& limits, Serial& nextSerial, EventLog& log) {
  Result<SceneRun> run = SceneRun::create(scene);
  if (!run) return run.error();
  return std::unique_ptr<LiveRun>(new LiveRun(source, scene, std::move(*run), limits, nextSerial, log));
}

Result<std::unique_ptr<LiveRun>> LiveRun::resume(const SavedState& saved, const SceneDescription& scene,
                                                 const HistoryLimits& limits, Serial& nextSerial, EventLog& log) {
  Result<SceneRun> run = SceneRun::create(scene);
  if (!run) return run.error();
  if (Status read = run->restore(saved.snapshot); !read) return read.error();
  return std::unique_ptr<LiveRun>(new LiveRun(saved.source, scene, std::move(*run), limits, nextSerial, log));
}

void LiveRun::begin() {
  auto list = std::make_shared<BodyList>();
  for (BodyId id : run_.world().bodies()) list->bodies.push_back(listed(run_, id, (*nextSerial_)++));
  list_ = std::move(list);
  history_.begin(run_.stepCount(), run_.time());
  Kept first = asItIs();
  first.regular = true;
  keep(std::move(first));
}

// Those that act at once follow the run; what waits for a restart stays.
void LiveRun::takeSettings() {
  for (const SettingRow& row : settingRows())
    if (row.live) setSetting(wanted_, row, settingOf(run_.scene(), row));
  changes_++;
  wanted_.materials = run_.scene().materials;
}

std::uint64_t LiveRun::settingsWait() const {
  std::uint64_t count = 0;
  for (const SettingRow& row : settingRows())
    count += !row.live && settingOf(wanted_, row) != settingOf(run_.scene(), row);
  return count;
}

Kept LiveRun::asItIs() const {
  Kept kept;
  kept.moment = now();
  kept.time = run_.time();
  kept.bytes = PackedBytes(run_.snapshot());
  kept.list = list_;
  kept.drag = drag_;
  return kept;
}

void LiveRun::keep(Kept kept) {
  workSinceKept_ = 0;
  history_.keep(std::move(kept));
}

void LiveRun::goOn() {
  if (now() != history_.end()) history_.cutAfter(now());
}

// --- Steps.

Result<StepReport> LiveRun::advance() {
  if (drag_)
    if (Status pulled = pull(run_.world(), *drag_, run_.scene().timeStep); !pulled) {
      if (!quiet_) log_->add(run_.time(), LogKind::warning, "let go: " + pulled.error().message);
      drag_.reset();
    }
  return run_.step();
}

Status LiveRun::step() {
  goOn();
  const Result<StepReport> report = advance();
  if (!report) return report.error();
  hear(*report);
  sample(*report);
  report_ = *report;
  history_.stepped(run_.time());
  if (recorder_)
    if (Status written = recorder_->afterStep(run_, *report); !written) {
      problems_.push_back("the recording ended: " + written.error().message);
      recorder_.reset();
    }
  workSinceKept_ += report->milliseconds;
  const bool due = history_.due(run_.time());
  if (!due && workSinceKept_ <= kMostWork) return {};
  Kept kept = asItIs();
  kept.regular = due;
  keep(std::move(kept));
  return {};
}

void LiveRun::hear(const StepReport& report) {
  const Events& events = run_.world().events();
  const double time = run_.time();
  for (const HitEvent& hit : events.hits)
    for (BodyId id : {hit.bodyA, hit.bodyB}) {
      if (id.index >= lastHit_.size()) lastHit_.resize(id.index + 1);
      Hit& last = lastHit_[id.index];
      last = {time, last.time == time ? std::max(last.speed, float(hit.approachSpeed)) : float(hit.approachSpeed)};
    }
  if (quiet_) return;
  std::vector<const HitEvent*> strongest;
  for (const HitEvent& hit : events.hits) strongest.push_back(&hit);
  const std::size_t shown = std::min(kMostHitLines, strongest.size());
  std::partial_sort(strongest.begin(), strongest.begin() + std::ptrdiff_t(shown), strongest.end(),
                    [](const HitEvent* a, const HitEvent* b) { return a->impulse > b->impulse; });
  for (std::size_t i = 0; i < shown; i++) {
    const HitEvent& hit = *strongest[i];
    log_->add(time, LogKind::hit,
              nameOfBody(hit.bodyA) + " and " + nameOfBody(hit.bodyB) + ": " + shortNumber(hit.approachSpeed) +
                  " m/s, " + shortNumber(hit.impulse) + " N s");
  }
  if (strongest.size() > shown)
    log_->add(time, LogKind::hit, "and " + std::to_string(strongest.size() - shown) + " weaker hits");
  const auto count = [&](const std::vector<BodyId>& bodies, LogKind kind, const char* what) {
    if (bodies.empty()) return;
    const std::string who = bodies.size() == 1 ? nameOfBody(bodies.front()) : std::to_string(bodies.size()) + " bodies";
    log_->add(time, kind, who + " " + what);
  };
  count(events.fellAsleep, LogKind::asleep, "fell asleep");
  count(events.woke, LogKind::awake, "woke");
  for (BodyId id : report.quarantined)
    log_->add(time, LogKind::quarantine, nameOfBody(id) + " became non-finite and is held where it was");
}

void LiveRun::sample(const StepReport& report) {
  StepSample s;
  s.time = run_.time();
  for (std::size_t k = 0; k < report.stageMilliseconds.size(); k++)
    s.stageMilliseconds[k] = float(report.stageMilliseconds[k]);
  s.milliseconds = float(report.milliseconds);
  s.awakeBodies = report.awakeBodies;
  s.contactPoints = report.contactPoints;
  s.touchingPoints = report.touchingPoints;
  s.islands = report.islands;
  s.restingIslands = report.restingIslands;
  s.impacts = report.impacts;
  s.cycles = report.cycles;
  samples_.push_back(s);
  if (samples_.size() > kSamples) samples_.pop_front();
}

double LiveRun::sinceHit(BodyId id) const {
  return run_.time() - (id.index < lastHit_.size() ? lastHit_[id.index] : Hit{}).time;
}

double LiveRun::hitSpeed(BodyId id) const { return id.index < lastHit_.size() ? lastHit_[id.index].speed : 0; }

// --- Back and forth.

std::string LiveRun::undoLabel() const {
  const Kept* last = history_.lastChange(now());
  return last ? last->change : std::string();
}

Status LiveRun::put(const Kept& kept) {
  const Result<std::vector<std::byte>> bytes = kept.bytes.unpacked();
  if (!bytes) return bytes.error();
  if (Status read = run_.restore(*bytes); !read) return read;
  list_ = kept.list;
  drag_ = kept.drag;
  commandsDone_ = kept.moment.commands;
  report_.reset();
  std::erase_if(samples_, [&](const StepSample& s) { return s.time > run_.time(); });
  for (Hit& hit : lastHit_)
    if (hit.time > run_.time()) hit = {};
  lastSetting_.clear();
  takeSettings();
  return {};
}

// The steps and commands from here to a moment that the history knows, as they were.
Status LiveRun::doAgain(const Moment& moment) {
  struct Quiet {
    bool& on;
    ~Quiet() { on = false; }
  };
  quiet_ = true;
  const Quiet until{quiet_};
  Status fine;
  while (fine && now() < moment) {
    const Logged* next = commandsDone_ < moment.commands ? history_.command(commandsDone_) : nullptr;
    if (next && next->step == run_.stepCount()) {
      Serial made = next->made;
      const Result<std::string> done = carryOut(next->command, made);
      if (!done) fine = done.error();
      commandsDone_++;
      continue;
    }
    if (run_.stepCount() >= moment.step) {
      fine = Error{ErrorCode::wrongState, "rewind: a command of that moment is no longer known"};
      continue;
    }
    const Result<StepReport> report = advance();
    if (!report) {
      fine = report.error();
      continue;
    }
    hear(*report);
    report_ = *report;
  }
  return fine;
}

Status LiveRun::goTo(const Moment& moment) {
  const Kept* from = history_.before(moment);
  if (!from) return Error{ErrorCode::wrongState, "rewind: that far back nothing is kept"};
  // Forward from here is nearer than from a snapshot before it.
  if (!(now() <= moment && now() >= from->moment))
    if (Status read = put(*from); !read) return read;
  lastSetting_.clear();
  return doAgain(moment);
}

Result<std::string> LiveRun::rewind(double time) {
  // A slider knows times less exactly than they are.
  const double slack = kRewindSlack * run_.scene().timeStep;
  if (!(time >= history_.earliest() - slack && time <= history_.latest() + slack))
    return Error{ErrorCode::invalidArgument, "rewind: found " + shortNumber(time) + " s, expected " +
                                                 shortNumber(history_.earliest()) + " .. " +
                                                 shortNumber(history_.latest()) + " s"};
  endRecording();
  if (Status there = goTo(history_.at(time)); !there) return there.error();
  return "at " + shortNumber(run_.time()) + " s";
}

Result<std::string> LiveRun::stepBack(int steps) {
  const std::uint64_t step = run_.stepCount();
  if (step < std::uint64_t(steps) || !history_.knows(step - std::uint64_t(steps)))
    return Error{ErrorCode::wrongState, "step back: that far back nothing is kept"};
  return rewind(history_.timeAt({step - std::uint64_t(steps), 0}));
}

Result<std::string> LiveRun::undo() {
  const Kept* last = history_.lastChange(now());
  if (!last) return Error{ErrorCode::wrongState, "undo: there is nothing to take back"};
  endRecording();
  if (Status read = put(*last); !read) return read.error();
  const std::string what = last->change;
  history_.cutAfter(last->moment);
  log_->add(run_.time(), LogKind::note, "taken back: " + what);
  return "taken back: " + what;
}

}  // namespace brickfall::viewer
