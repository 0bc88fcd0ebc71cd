// The bodies of a world are handed to the report's system as boxes, and their motion is handed back.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>

#include "base/archive.h"
#include "report/report_system.h"

namespace brickfall {

namespace {

constexpr double kPlaneHalfSize = 200, kPlaneHalfDepth = 10;  // m: a plane as a box

// What of a body does not change from step to step.
struct Form {
  ReportBody box;    // without its state
  Vec3 localCentre;  // m, centre of mass in the body's frame
  Transform plane;   // in the body's frame
  bool isPlane = false;
};

// The box around all shapes, with its centre at the centre of mass.
Vec3 halfExtentsOf(const World& world, BodyId body, Vec3 localCentre) {
  Vec3 half;
  for (ShapeId id : world.shapes(body)) {
    Aabb box = bounds(*world.shape(id), Transform{-localCentre, {}});
    half = max(half, max(abs(box.lower), abs(box.upper)));
  }
  return half;
}

Form formOf(const World& world, BodyId body) {
  Form form;
  const ShapeDef first = *world.shape(world.shapes(body).front());
  const MassProperties mass = *world.massProperties(body);
  if (mass.mass > 0) form.localCentre = mass.centre;
  form.box.id = std::uint64_t(body.generation) << 32 | body.index;
  form.box.mass = {mass.mass, mass.inertia};
  form.box.friction = first.material.friction;
  form.box.restitution = first.material.restitution;
  form.isPlane = first.type == ShapeType::plane;
  if (form.isPlane) {
    form.plane = first.local;
    form.box.halfExtents = {kPlaneHalfSize, kPlaneHalfDepth, kPlaneHalfSize};
  } else {
    form.box.halfExtents = halfExtentsOf(world, body, form.localCentre);
  }
  return form;
}

ReportBody boxOf(const Form& form, const BodyState& s) {
  ReportBody box = form.box;
  if (s.type != BodyType::dynamic) box.mass.mass = 0;
  box.state = {s.centreOfMass, s.rotation, s.linearVelocity, s.angularVelocity};
  if (form.isPlane) {
    Transform plane = Transform{s.position, s.rotation} * form.plane;
    box.state.rotation = plane.rotation;
    box.state.position = plane.position - rotate(plane.rotation, Vec3{0, kPlaneHalfDepth, 0});
  }
  return box;
}

double millisecondsNow() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Error outOfRange(const char* field, double found, const char* expected) {
  return {ErrorCode::invalidArgument,
          std::string(field) + ": found " + std::to_string(found) + ", expected " + expected};
}

}  // namespace

struct ReportRun::Impl {
  ReportSystem system;
  std::map<BodyId, Form> forms;
  std::set<BodyId> lost;  // whose motion the world refused
  std::vector<std::pair<BodyId, BodyId>> collisions;
  double time = 0;  // s
  std::uint64_t steps = 0;

  explicit Impl(const ReportSettings& settings) : system(settings) {}

  const Form& form(const World& world, BodyId body) {
    auto known = forms.find(body);
    if (known == forms.end()) known = forms.emplace(body, formOf(world, body)).first;
    return known->second;
  }
  void advance(World& world, double dt, StepReport& report);
  bool put(World& world, BodyId body, const BodyState& before, const ReportBody& box, double dt);
};

// False, and the body at rest where it was, if the world refuses the motion.
bool ReportRun::Impl::put(World& world, BodyId body, const BodyState& before, const ReportBody& box, double dt) {
  Vec3 centre = box.state.position;
  Quat rotation = box.state.rotation;
  if (before.type == BodyType::kinematic) {
    centre = before.centreOfMass + before.linearVelocity * dt;
    rotation = normalized(quatFromRotationVector(before.angularVelocity * dt) * before.rotation);
  }
  Vec3 origin = centre - toMatrix(rotation) * form(world, body).localCentre;
  bool taken = world.setTransform(body, origin, rotation).ok();
  if (before.type == BodyType::kinematic) return taken;
  taken = taken && world.setLinearVelocity(body, box.state.velocity).ok() &&
          world.setAngularVelocity(body, box.state.angularVelocity).ok();
  if (taken) return true;
  // It had this pose, and velocity 0 is never refused.
  (void)world.setTransform(body, before.position, before.rotation).ok();
  (void)world.setLinearVelocity(body, {}).ok();
  (void)world.setAngularVelocity(body, {}).ok();
  return false;
}

void ReportRun::Impl::advance(World& world, double dt, StepReport& report) {
  std::vector<ReportBody> boxes;
  std::vector<BodyState> states;
  std::vector<BodyId> ids;
  report.bodies = 0;
  for (BodyId body : world.bodies()) {
    const BodyState s = *world.state(body);
    report.bodies += s.type == BodyType::dynamic;
    if (s.quarantined || lost.count(body) > 0) continue;
    boxes.push_back(boxOf(form(world, body), s));
    states.push_back(s);
    ids.push_back(body);
  }
  report.awakeBodies = report.bodies;
  system.step(boxes, world.gravity(), dt);
  report.manifolds = report.touchingPoints = system.collisions();
  collisions.clear();
  for (const auto& [a, b] : system.collided()) collisions.push_back({ids[a], ids[b]});
  for (std::size_t i = 0; i < boxes.size(); i++) {
    if (states[i].type == BodyType::fixed || put(world, ids[i], states[i], boxes[i], dt)) continue;
    lost.insert(ids[i]);
    report.quarantined.push_back(ids[i]);
  }
  time += dt;
  steps++;
}

ReportRun::ReportRun(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ReportRun::ReportRun(ReportRun&&) noexcept = default;
ReportRun& ReportRun::operator=(ReportRun&&) noexcept = default;
ReportRun::~ReportRun() = default;

Result<ReportRun> ReportRun::create(const ReportSettings& s) {
  if (!(s.impulseFactor >= 0 && s.impulseFactor <= 100))
    return outOfRange("report.impulseFactor", s.impulseFactor, "0 .. 100");
  if (!(s.damping >= 0 && s.damping <= 1e6)) return outOfRange("report.damping", s.damping, "0 .. 1e6");
  if (!(s.sweeps >= 1 && s.sweeps <= 1000)) return outOfRange("report.sweeps", s.sweeps, "1 .. 1000");
  if (!(int(s.integrator) < kIntegratorCount))
    return outOfRange("report.integrator", int(s.integrator), "an Integrator");
  return ReportRun(std::make_unique<Impl>(s));
}

Result<StepReport> ReportRun::step(World& world, double dt, int substeps) {
  if (!(dt > 0 && dt < 1e9)) return outOfRange("dt", dt, "a time in s, more than 0");
  if (!(substeps >= 1)) return outOfRange("substeps", substeps, "1 or more");
  double start = millisecondsNow();
  Impl& run = *impl_;
  std::erase_if(run.forms, [&](const auto& entry) { return !world.isValid(entry.first); });
  std::erase_if(run.lost, [&](BodyId body) { return !world.isValid(body); });
  StepReport report;
  for (int i = 0; i < substeps; i++) run.advance(world, dt / substeps, report);
  report.stepIndex = run.steps;
  report.time = run.time;
  report.milliseconds = report.stageMilliseconds[std::size_t(Stage::integrate)] = millisecondsNow() - start;
  return report;
}

const std::vector<std::pair<BodyId, BodyId>>& ReportRun::collisions() const { return impl_->collisions; }

void ReportRun::rereadBodies() { impl_->forms.clear(); }

std::vector<std::byte> ReportRun::snapshot() const {
  WriteArchive archive;
  archive.value(impl_->time);
  archive.value(impl_->steps);
  archive.value(std::uint64_t(impl_->lost.size()));
  for (BodyId body : impl_->lost) {
    archive.value(body.index);
    archive.value(body.generation);
  }
  impl_->system.write(archive);
  return archive.take();
}

Status ReportRun::restore(std::span<const std::byte> snapshot, const World& world) {
  const Error bad{ErrorCode::badFormat, "snapshot: what the report's system remembers does not fit its length"};
  ReadArchive archive(snapshot);
  double time = 0;
  std::uint64_t steps = 0;
  archive.value(time);
  archive.value(steps);
  std::set<std::pair<std::uint32_t, std::uint16_t>> lost;
  const std::uint64_t count = archive.count(0, sizeof(std::uint32_t) + sizeof(std::uint16_t));
  for (std::uint64_t i = 0; i < count; i++) {
    std::pair<std::uint32_t, std::uint16_t> body;
    archive.value(body.first);
    archive.value(body.second);
    lost.insert(body);
  }
  ReportSystem system = impl_->system;
  if (!system.read(archive) || !archive.atEnd() || !(time >= 0 && std::isfinite(time))) return bad;
  impl_->system = std::move(system);
  impl_->time = time;
  impl_->steps = steps;
  impl_->forms.clear();
  impl_->collisions.clear();
  impl_->lost.clear();
  for (BodyId body : world.bodies())
    if (lost.count({body.index, body.generation}) > 0) impl_->lost.insert(body);
  return {};
}

}  // namespace brickfall
