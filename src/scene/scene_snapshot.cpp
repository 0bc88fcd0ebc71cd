// A scene's run as bytes, and back: its world's snapshot, and what the run itself knows. Shapes of bodies are those that the
// world has; names, roles and what they were made with stand here.
//
// Layout: magic, layout number, hash of what follows but the world's own bytes (they have their own); those bytes; the rest.
// The hash finds damage, not intent: what is read is checked as the calls check what they are given.
#include <algorithm>
#include <cmath>

#include "base/archive.h"
#include "base/hash.h"
#include "brickfall/limits.h"
#include "brickfall/scene.h"

namespace brickfall {

namespace {

constexpr std::uint64_t kMagic = 0x314e5552464b5242ull;
constexpr std::uint32_t kLayout = 4;
constexpr std::size_t kLeastBody = 100, kLeastMaterial = 20;  // bytes: a forged count can't claim much more memory

struct Header {
  std::uint64_t magic = kMagic;
  std::uint32_t layout = kLayout;
  std::uint32_t unused = 0;
  std::uint64_t worldBytes = 0;
  std::uint64_t hash = 0;
};

std::uint64_t hashOf(std::span<const std::byte> bytes) {
  Hash hash;
  for (std::byte b : bytes) hash.addByte(std::uint8_t(b));
  return hash.value();
}

Error badSnapshot(const std::string& why) { return {ErrorCode::badFormat, "snapshot of a run: " + why}; }

template <class Archive, class Text> void text(Archive& a, Text& s) {
  std::vector<char> letters(s.begin(), s.end());
  a.list(letters);
  if constexpr (Archive::kReading) s.assign(letters.begin(), letters.end());
}

template <class Archive, class List> void length(Archive& a, List& list, std::size_t leastSize) {
  const std::uint64_t n = a.count(list.size(), leastSize);
  if constexpr (Archive::kReading) list.resize(std::size_t(n));
}

}  // namespace

// What a run has besides its world, read before anything of it is changed.
struct RunState {
  struct Body {
    PlacedBody placed;
    bool waits = false;  // for its launch
  };
  double time = 0, timeStep = 0, actedUntil = 0;
  std::int32_t substeps = 1;
  std::uint64_t stepsDone = 0;
  std::vector<MaterialDef> materials;
  std::vector<Body> bodies;
  std::vector<std::byte> reported;
};

class RunArchive {
 public:
  template <class Archive, class State> static void state(Archive& a, State& s) {
    a.value(s.time);
    a.value(s.timeStep);
    a.value(s.actedUntil);
    a.value(s.substeps);
    a.value(s.stepsDone);
    length(a, s.materials, kLeastMaterial);
    for (auto& def : s.materials) material(a, def);
    length(a, s.bodies, kLeastBody);
    for (auto& listed : s.bodies) {
      body(a, listed.placed);
      a.flag(listed.waits);
    }
    a.list(s.reported);
  }

  static RunState stateOf(const SceneRun& run) {
    RunState s;
    s.time = run.time_;
    s.timeStep = run.scene_.timeStep;
    s.substeps = run.scene_.substeps;
    s.actedUntil = run.machines_.actedUntil();
    s.stepsDone = run.stepsDone_;
    s.materials = run.scene_.materials;
    std::vector<bool> waits(run.bodies_.size(), false);
    for (BodyId id : run.waiting_)
      if (const PlacedBody* body = run.find(id)) waits[std::size_t(body - run.bodies_.data())] = true;
    for (std::size_t k = 0; k < run.bodies_.size(); k++)
      if (run.world_.isValid(run.bodies_[k].id)) s.bodies.push_back({run.bodies_[k], waits[k]});
    if (run.reported_) s.reported = run.reported_->snapshot();
    return s;
  }

  static Status put(RunState&& s, std::span<const std::byte> world, SceneRun& run);

 private:
  template <class Archive, class Def> static void material(Archive& a, Def& d) {
    text(a, d.name);
    a.value(d.material.density);
    a.value(d.material.friction);
    a.value(d.material.restitution);
    a.value(d.material.rollingResistance);
    a.value(d.material.hardness);
    a.choice(d.material.frictionRule, CombineRule::maximum);
    a.choice(d.material.restitutionRule, CombineRule::maximum);
    a.value(d.colour);
  }

  template <class Archive, class Placed> static void body(Archive& a, Placed& b) {
    a.value(b.id.index);
    a.value(b.id.generation);
    text(a, b.name);
    a.choice(b.role, BodyRole(kBodyRoleCount - 1));
    a.value(b.colour);
    a.value(b.launchTime);
    a.value(b.course);
    a.value(b.place);
    length(a, b.materials, sizeof(std::uint64_t));
    for (auto& name : b.materials) text(a, name);
    auto& d = b.def;
    a.choice(d.type, BodyType::dynamic);
    a.value(d.position);
    a.value(d.rotation);
    a.value(d.linearVelocity);
    a.value(d.angularVelocity);
    a.value(d.surfaceVelocity);
    for (auto* number : {&d.gravityScale, &d.linearDamping, &d.angularDamping, &d.dragArea}) a.value(*number);
    a.flag(d.allowSleep);
    a.value(d.userData);
  }
};

namespace {

bool inRange(Vec3 v, double limit) {  // in the positive form: NaN is not
  return std::fabs(v.x) <= limit && std::fabs(v.y) <= limit && std::fabs(v.z) <= limit;
}

// What a body was made with: its launch takes type and velocities from there.
bool soundMaking(const PlacedBody& body) {
  const BodyDef& d = body.def;
  return inRange(d.position, limits::kLargestCoordinate) && isFinite(d.rotation) &&
         inRange(d.linearVelocity, limits::kLargestSpeed) && inRange(d.surfaceVelocity, limits::kLargestSpeed) &&
         inRange(d.angularVelocity, limits::kLargestSpeed) &&
         std::fabs(d.gravityScale) <= limits::kLargestGravityScale && d.linearDamping >= 0 &&
         d.linearDamping <= limits::kLargestDamping && d.angularDamping >= 0 &&
         d.angularDamping <= limits::kLargestDamping && d.dragArea >= 0 && d.dragArea <= limits::kLargestDragArea &&
         !std::isnan(body.launchTime);
}

Status checkState(const RunState& s) {
  if (!(s.time >= 0 && std::isfinite(s.time)) || !(s.actedUntil <= s.time) ||
      !(s.timeStep >= limits::kShortestTimeStep && s.timeStep <= limits::kLongestTimeStep) ||
      !(s.substeps >= 1 && s.substeps <= limits::kMostSubsteps))
    return badSnapshot("its time is out of range");
  for (const MaterialDef& def : s.materials)
    if (Status fine = checkMaterial(def.material); !fine)
      return badSnapshot("material \"" + def.name + "\": " + fine.error().message);
  std::vector<std::uint32_t> slots;
  for (const RunState::Body& body : s.bodies) {
    if (!soundMaking(body.placed)) return badSnapshot("body \"" + body.placed.name + "\": a number is out of range");
    slots.push_back(body.placed.id.index);
  }
  std::sort(slots.begin(), slots.end());
  if (std::adjacent_find(slots.begin(), slots.end()) != slots.end()) return badSnapshot("it has a body twice");
  return {};
}

}  // namespace

// All is checked and read before anything changes; the world is the last that can fail.
Status RunArchive::put(RunState&& s, std::span<const std::byte> world, SceneRun& run) {
  if (Status fine = checkState(s); !fine) return fine;
  if (run.reported_.has_value() == s.reported.empty()) return badSnapshot("made of a scene with another method");
  std::optional<ReportRun> reported;
  if (run.reported_) {
    Result<ReportRun> made = ReportRun::create(run.scene_.report);
    if (!made) return made.error();
    if (Status read = made->restore(s.reported, run.world_); !read) return read;
    reported = std::move(made).value();
  }
  if (Status read = run.world_.restore(world); !read) return read;
  if (reported) {  // once more: whom it has lost is told by the world as it is now
    (void)reported->restore(s.reported, run.world_).ok();
    run.reported_ = std::move(reported);
  }
  std::vector<BodyId> byIndex;
  for (BodyId id : run.world_.bodies()) {
    if (id.index >= byIndex.size()) byIndex.resize(id.index + 1);
    byIndex[id.index] = id;
  }
  run.waiting_.clear();
  std::vector<PlacedBody> there;
  for (RunState::Body& listed : s.bodies) {
    PlacedBody& body = listed.placed;
    const BodyId id = body.id.index < byIndex.size() ? byIndex[body.id.index] : BodyId{};
    if (!id || id.generation != body.id.generation) continue;
    body.id = id;
    for (ShapeId shape : run.world_.shapes(id)) body.def.shapes.push_back(*run.world_.shape(shape));
    if (listed.waits) run.waiting_.push_back(id);
    there.push_back(std::move(body));
  }
  run.list(std::move(there));
  run.scene_.world = run.world_.definition();
  run.scene_.timeStep = s.timeStep;
  run.scene_.substeps = s.substeps;
  run.scene_.materials = std::move(s.materials);
  run.stepsDone_ = s.stepsDone;
  run.time_ = s.time;
  run.machines_.setActedUntil(s.actedUntil);
  return {};
}

std::vector<std::byte> SceneRun::snapshot() const {
  WriteArchive rest;
  RunState state = RunArchive::stateOf(*this);
  RunArchive::state(rest, state);
  const std::vector<std::byte> world = world_.snapshot(), own = rest.take();
  Header header;
  header.worldBytes = world.size();
  header.hash = hashOf(own);
  WriteArchive head;
  head.value(header);
  std::vector<std::byte> out = head.take();
  out.reserve(out.size() + world.size() + own.size());
  out.insert(out.end(), world.begin(), world.end());
  out.insert(out.end(), own.begin(), own.end());
  return out;
}

Status SceneRun::restore(std::span<const std::byte> snapshot) {
  Header header;
  if (snapshot.size() < sizeof header)
    return badSnapshot("found " + std::to_string(snapshot.size()) + " bytes, expected at least " +
                       std::to_string(sizeof header));
  std::memcpy(&header, snapshot.data(), sizeof header);
  if (header.magic != kMagic) return badSnapshot("these bytes are not one");
  if (header.layout != kLayout)
    return badSnapshot("made by another version (layout " + std::to_string(header.layout) + ", expected " +
                       std::to_string(kLayout) + ")");
  const std::span<const std::byte> rest = snapshot.subspan(sizeof header);
  if (header.worldBytes > rest.size()) return badSnapshot("cut off");
  const std::span<const std::byte> own = rest.subspan(std::size_t(header.worldBytes));
  if (header.hash != hashOf(own)) return badSnapshot("damaged or cut off (its checksum differs)");
  ReadArchive archive(own);
  RunState state;
  RunArchive::state(archive, state);
  if (archive.failed() || !archive.atEnd()) return badSnapshot("its lists do not fit its length");
  return RunArchive::put(std::move(state), rest.first(std::size_t(header.worldBytes)), *this);
}

}  // namespace brickfall
