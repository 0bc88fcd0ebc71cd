// What the user does to a live run.
#include <algorithm>
#include <cmath>

#include "viewer_core/live_run.h"
#include "viewer_core/settings_table.h"

namespace brickfall::viewer {

namespace {

constexpr double kOneChange = 1;  // s, simulated: changes of a setting that follow each other sooner are one to undo

Error outOfRange(const std::string& what, double found, const std::string& expected) {
  return {ErrorCode::invalidArgument, what + ": found " + shortNumber(found) + ", expected " + expected};
}

// What Undo would say of it; empty: there is nothing to take back.
std::string changeOf(const Command& command) {
  if (std::holds_alternative<ShootBall>(command)) return "the ball";
  if (std::holds_alternative<DragBegin>(command)) return "dragging";
  if (std::holds_alternative<RemoveBody>(command)) return "the removal";
  if (std::holds_alternative<Explode>(command)) return "the blast";
  if (std::holds_alternative<CutJoints>(command)) return "the cut";
  if (std::holds_alternative<TiltGround>(command)) return "the tilt";
  if (std::holds_alternative<KickGround>(command)) return "the jerk";
  if (const auto* setting = std::get_if<ChangeSetting>(&command)) return setting->key;
  if (const auto* material = std::get_if<ChangeMaterial>(&command)) return "material " + material->name;
  return {};
}

}  // namespace

Result<std::string> LiveRun::execute(const Command& command) {
  if (const auto* at = std::get_if<Rewind>(&command)) return rewind(at->time);
  if (std::holds_alternative<Undo>(command)) return undo();
  if (const auto* file = std::get_if<SaveState>(&command)) return save(file->path);
  if (const auto* file = std::get_if<StartRecording>(&command)) return startRecording(file->path);
  if (std::holds_alternative<StopRecording>(command)) {
    if (!recorder_) return Error{ErrorCode::wrongState, "stop recording: nothing is being recorded"};
    return stopRecording();
  }
  return makeChange(command);
}

bool LiveRun::continuesLast(const ChangeSetting& change) const {
  return change.key == lastSetting_ && commandsDone_ == lastSettingCommand_ &&
         run_.time() < lastSettingTime_ + kOneChange && now() == history_.end();
}

// Carried out between two steps, and written down with the step, so that it can be done again.
Result<std::string> LiveRun::makeChange(const Command& command) {
  const auto* setting = std::get_if<ChangeSetting>(&command);
  const SettingRow* row = setting ? findSetting(setting->key) : nullptr;
  if (row && !row->live) {
    if (!setSetting(wanted_, *row, setting->value))
      return outOfRange(setting->key, setting->value, shortNumber(row->least) + " .. " + shortNumber(row->most));
    changes_++;
    return std::string(row->label) + " waits for a restart";
  }
  const std::string label = setting && continuesLast(*setting) ? std::string() : changeOf(command);
  // What is refused changes nothing, so the history hears only of what was carried out.
  const Moment before = now();
  std::optional<Kept> kept;
  if (!label.empty() && !history_.keptAt(before)) kept = asItIs();
  Serial made = 0;
  const Result<std::string> answer = carryOut(command, made);
  if (!answer) return answer;
  goOn();
  if (kept) keep(std::move(*kept));
  if (!label.empty()) history_.nameChange(label);
  history_.did(command, made);
  commandsDone_++;
  if (setting) {
    lastSetting_ = setting->key;
    lastSettingTime_ = run_.time();
    lastSettingCommand_ = commandsDone_;
  }
  return answer;
}

Result<std::string> LiveRun::carryOut(const Command& command, Serial& made) {
  if (const auto* c = std::get_if<ShootBall>(&command)) return carryOut(*c, made);
  if (const auto* c = std::get_if<DragBegin>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<DragMove>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<DragEnd>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<RemoveBody>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<WakeBody>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<Explode>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<CutJoints>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<TiltGround>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<KickGround>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<ChangeSetting>(&command)) return carryOut(*c);
  if (const auto* c = std::get_if<ChangeMaterial>(&command)) return carryOut(*c);
  return Error{ErrorCode::wrongState, std::string(nameOf(command)) + ": not a change of a run"};
}

Result<BodyId> LiveRun::bodyOf(Serial serial) const {
  const int place = list_->find(serial);
  if (place < 0) return Error{ErrorCode::staleId, "body: it is gone"};
  return list_->bodies[std::size_t(place)].id;
}

std::string LiveRun::nameOfBody(BodyId id) const {
  const PlacedBody* placed = run_.find(id);
  return placed ? placed->name : "body " + std::to_string(id.index);
}

void LiveRun::relist() {
  auto list = std::make_shared<BodyList>();
  for (const ListedBody& body : list_->bodies)
    if (run_.world().isValid(body.id)) list->bodies.push_back(listed(run_, body.id, body.serial));
  list_ = std::move(list);
}

void LiveRun::listBody(BodyId id, Serial serial) {
  auto list = std::make_shared<BodyList>(*list_);
  list->bodies.push_back(listed(run_, id, serial));
  list_ = std::move(list);
  if (id.index < lastHit_.size()) lastHit_[id.index] = {};
}

Result<std::string> LiveRun::carryOut(const ShootBall& shot, Serial& made) {
  const double along = length(shot.ray.direction);
  if (!(along > 1e-6 && along < 1e6)) return outOfRange("shoot: direction", along, "a length that is not zero");
  if (!(shot.radius > 0)) return outOfRange("shoot: radius", shot.radius, "more than 0 m");
  if (!(shot.speed >= 0)) return outOfRange("shoot: speed", shot.speed, "0 m/s or more");
  const std::optional<MaterialDef> material = run_.material(shot.material);
  if (!material)
    return Error{ErrorCode::invalidArgument,
                 "shoot: found the material \"" + shot.material + "\", expected one of the scene or a predefined one"};
  int number = 1;
  for (const ListedBody& body : list_->bodies) number += body.name.starts_with("shot ");
  PlacedBody ball;
  ball.name = "shot " + std::to_string(number);
  ball.role = BodyRole::ball;
  ball.colour = material->colour;
  ball.materials = {shot.material};
  ball.def.position = shot.ray.origin;
  ball.def.linearVelocity = shot.ray.direction * (shot.speed / along);
  ball.def.shapes.resize(1);
  ball.def.shapes[0].type = ShapeType::sphere;
  ball.def.shapes[0].radius = shot.radius;
  ball.def.shapes[0].material = material->material;
  const Result<BodyId> id = run_.createBody(std::move(ball));
  if (!id) return Error{id.error().code, "shoot: " + id.error().message};
  if (made == 0) made = (*nextSerial_)++;
  listBody(*id, made);
  const std::string what =
      nameOfBody(*id) + ": " + shortNumber(list_->bodies.back().mass) + " kg at " + shortNumber(shot.speed) + " m/s";
  if (!quiet_) log_->add(run_.time(), LogKind::launch, what);
  return what;
}

Result<std::string> LiveRun::carryOut(const DragBegin& begin) {
  if (run_.reported())
    return Error{ErrorCode::wrongState,
                 "drag: found the report's system, which knows no forces, expected the engine's own"};
  if (!(begin.strength > 0 && begin.strength <= 1e6))
    return outOfRange("drag: strength", begin.strength, "more than 0, at most 1e6 weights");
  if (!isFinite(begin.local)) return Error{ErrorCode::invalidArgument, "drag: found a point that is not finite"};
  const Result<BodyId> id = bodyOf(begin.body);
  if (!id) return Error{id.error().code, "drag: " + id.error().message};
  if (Status fine = checkDraggable(run_.world(), *id); !fine)
    return Error{fine.error().code, "drag: " + nameOfBody(*id) + ": " + fine.error().message};
  DragSpring spring;
  spring.body = *id;
  spring.serial = begin.body;
  spring.local = begin.local;
  spring.strength = begin.strength;
  spring.target = heldPoint(run_.world(), spring);
  drag_ = spring;
  return nameOfBody(*id) + " is held";
}

Result<std::string> LiveRun::carryOut(const DragMove& move) {
  if (!drag_) return Error{ErrorCode::wrongState, "drag: nothing is held"};
  if (!isFinite(move.target)) return Error{ErrorCode::invalidArgument, "drag: found a target that is not finite"};
  drag_->target = move.target;
  return std::string();
}

Result<std::string> LiveRun::carryOut(const DragEnd&) {
  drag_.reset();
  return std::string();
}

Result<std::string> LiveRun::carryOut(const RemoveBody& remove) {
  const Result<BodyId> id = bodyOf(remove.body);
  if (!id) return Error{id.error().code, "remove: " + id.error().message};
  const std::string name = nameOfBody(*id);
  if (Status gone = run_.destroyBody(*id); !gone) return Error{gone.error().code, "remove: " + gone.error().message};
  if (drag_ && drag_->serial == remove.body) drag_.reset();
  auto list = std::make_shared<BodyList>(*list_);
  list->bodies.erase(list->bodies.begin() + list->find(remove.body));
  list_ = std::move(list);
  if (!quiet_) log_->add(run_.time(), LogKind::note, name + " was removed");
  return name + " was removed";
}

Result<std::string> LiveRun::carryOut(const WakeBody& wake) {
  if (wake.body != 0) {
    const Result<BodyId> id = bodyOf(wake.body);
    if (!id) return Error{id.error().code, "wake: " + id.error().message};
    if (Status woke = run_.world().wake(*id); !woke) return Error{woke.error().code, "wake: " + woke.error().message};
    return nameOfBody(*id) + " was woken";
  }
  for (const ListedBody& body : list_->bodies) {
    const Result<BodyState> state = run_.world().state(body.id);
    // A quarantined one can't be.
    if (state && state->type == BodyType::dynamic && !state->quarantined) (void)run_.world().wake(body.id).ok();
  }
  return std::string("all were woken");
}

Result<std::string> LiveRun::carryOut(const Explode& blast) {
  const Result<BlastReport> done =
      applyBlast(run_.world(), {.centre = blast.centre, .impulse = blast.impulse, .radius = blast.radius});
  if (!done) return Error{done.error().code, "blast: " + done.error().message};
  const std::string what =
      "a blast pushed " + std::to_string(done->bodies) + " bodies, " + shortNumber(done->impulse) + " N s in all";
  if (!quiet_) log_->add(run_.time(), LogKind::note, what);
  return what;
}

Result<std::string> LiveRun::carryOut(const CutJoints& cut) {
  const Result<BodyId> id = bodyOf(cut.body);
  if (!id) return Error{id.error().code, "cut: " + id.error().message};
  const std::vector<JointId> joints = run_.world().joints(*id);
  if (joints.empty()) return Error{ErrorCode::wrongState, "cut: no joint holds " + nameOfBody(*id)};
  for (JointId joint : joints)
    if (Status gone = run_.world().destroyJoint(joint); !gone)
      return Error{gone.error().code, "cut: " + gone.error().message};
  const std::string what = nameOfBody(*id) + " was cut off";
  if (!quiet_) log_->add(run_.time(), LogKind::note, what);
  return what;
}

Result<std::string> LiveRun::carryOut(const TiltGround& tilt) {
  const double size = length(tilt.axis);
  if (!(size > 1e-6 && size < 1e6)) return outOfRange("tilt: axis", size, "a length that is not zero");
  if (!(std::fabs(tilt.degrees) <= 180)) return outOfRange("tilt: degrees", tilt.degrees, "-180 .. 180");
  constexpr double kRadians = 3.14159265358979323846 / 180;
  WorldDef world = run_.scene().world;
  world.gravity = rotate(quatFromAxisAngle(tilt.axis * (1 / size), -tilt.degrees * kRadians), run_.world().gravity());
  if (Status done = run_.setWorld(world); !done) return done.error();
  wanted_.world.gravity = world.gravity;
  changes_++;
  return "the ground tilts by " + shortNumber(tilt.degrees) + " degrees";
}

Result<std::string> LiveRun::carryOut(const KickGround& kick) {
  if (!(length(kick.velocity) <= 100)) return outOfRange("shake: velocity", length(kick.velocity), "at most 100 m/s");
  World& world = run_.world();
  for (const ListedBody& body : list_->bodies) {
    const Result<BodyState> state = world.state(body.id);
    if (!state || state->type != BodyType::dynamic || state->quarantined) continue;
    if (Status set = world.setLinearVelocity(body.id, state->linearVelocity - kick.velocity); !set)
      return Error{set.error().code, "shake: " + set.error().message};
  }
  return std::string("the ground is jerked");
}

Result<std::string> LiveRun::carryOut(const ChangeSetting& change) {
  const SettingRow* row = findSetting(change.key);
  if (!row)
    return Error{ErrorCode::invalidArgument, "set: found \"" + change.key + "\", expected the key of a setting"};
  SceneDescription scene = wanted_;
  if (!setSetting(scene, *row, change.value))
    return outOfRange(change.key, change.value,
                      (row->kind == SettingKind::real ? "" : "a whole number in ") + shortNumber(row->least) + " .. " +
                          shortNumber(row->most));
  WorldDef world = scene.world;
  // These wait for a restart.
  world.maxBodies = run_.scene().world.maxBodies;
  world.broadPhase = run_.scene().world.broadPhase;
  world.solver.contactMargin = run_.scene().world.solver.contactMargin;
  Status done = row->group == "Time" ? run_.setTimeStep(scene.timeStep, scene.substeps) : run_.setWorld(world);
  if (!done) return done.error();
  wanted_.timeStep = scene.timeStep;
  wanted_.substeps = scene.substeps;
  wanted_.world = scene.world;
  changes_++;
  return std::string();
}

Result<std::string> LiveRun::carryOut(const ChangeMaterial& change) {
  const std::optional<MaterialDef> def = run_.material(change.name);
  if (!def)
    return Error{ErrorCode::invalidArgument,
                 "material: found \"" + change.name + "\", expected one of the scene or a predefined one"};
  Material material = def->material;
  material.density = change.density;
  material.friction = change.friction;
  material.restitution = change.restitution;
  material.rollingResistance = change.rollingResistance;
  if (Status done = run_.setMaterial(change.name, material); !done) return done.error();
  wanted_.materials = run_.scene().materials;
  changes_++;
  if (change.density != def->material.density) relist();
  return std::string();
}

// --- Files.

Result<std::string> LiveRun::save(const std::string& path) const {
  SavedSettings settings;
  for (const SettingRow& row : settingRows())
    if (!row.live) settings.push_back({std::string(row.key), settingOf(run_.scene(), row)});
  const Result<std::size_t> size = writeState(path, {source_, settings, run_.snapshot()});
  if (!size) return size.error();
  return "saved " + path + ", " + shortNumber(double(*size) * 1e-6) + " MB";
}

Result<std::string> LiveRun::startRecording(const std::string& path) {
  if (recorder_) return Error{ErrorCode::wrongState, "record: " + recordingPath_ + " is being recorded"};
  Result<TakeRecorder> recorder = TakeRecorder::create(path, run_);
  if (!recorder) return recorder.error();
  goOn();
  recorder_ = std::move(*recorder);
  recordingPath_ = path;
  log_->add(run_.time(), LogKind::note, "recording to " + path);
  return "recording to " + path;
}

Result<std::string> LiveRun::stopRecording() {
  if (!recorder_) return std::string();
  const Status finished = recorder_->finish({});
  recorder_.reset();
  if (!finished) return Error{finished.error().code, "recording: " + finished.error().message};
  log_->add(run_.time(), LogKind::note, "recorded " + recordingPath_);
  return "recorded " + recordingPath_;
}

void LiveRun::endRecording() {
  if (const Result<std::string> stopped = stopRecording(); !stopped) problems_.push_back(stopped.error().message);
}

}  // namespace brickfall::viewer
