// A world as bytes, and back. The bytes hold all that a step reads and the rest does not determine, so that a restored
// world goes on bit for bit. Masses, hulls and the places of shapes follow from the definitions of bodies. The tree of
// the broad phase is built anew: which contacts exist does not depend on its shape.
//
// Layout: magic, layout number, hash of the rest; the fields in the order below, as this machine has them in memory.
// The hash finds damage, not intent: nothing that is read is trusted (snapshot_check.cpp).
#include <algorithm>

#include "base/archive.h"
#include "base/hash.h"
#include "brickfall/geometry/mesh_tree.h"
#include "world/solver_fields.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! not of the method: the file's
constexpr std::uint64_t kMagic = 0x30504e5346424b42ull;
constexpr std::uint32_t kLayout = 32;

struct Header {
  std::uint64_t magic = kMagic;
  std::uint32_t layout = kLayout;
  std::uint32_t recordSize = Rows::recordSize();  // tells builds with another memory layout apart
  std::uint64_t hash = 0;
};

// Fewest bytes of an item: a forged count can't claim much more memory than the snapshot has.
//! not of the method: the file's
constexpr std::size_t kLeastSlot = 3, kLeastLevel = 32, kLeastIsland = 140;

std::uint64_t hashOf(std::span<const std::byte> bytes) {
  Hash hash;
  for (std::byte b : bytes) hash.addByte(std::uint8_t(b));
  return hash.value();
}

Error badSnapshot(const std::string& why) { return {ErrorCode::badFormat, "snapshot: " + why}; }

}  // namespace

// Sees the private lists of the sets.
class SnapshotArchive {
 public:
  template <class Archive, class Impl> static void world(Archive& a, Impl& w) {
    definition(a, w.def);
    bodies(a, w.registry.bodies);
    shapes(a, w.registry.shapes, w.proximity.around);
    w.ties.archive(a);
    islandList(a, w.activity.islands.awake, &w.solve.memory);
    islandList(a, w.activity.islands.asleep, &w.solve.memory);
    a.list(w.activity.islands.single);
    a.list(w.activity.awake);
    a.list(w.activity.moving);
    a.list(w.activity.islandOf);
    a.flag(w.activity.membershipChanged);
    for (auto* seconds : {&w.clock.time, &w.clock.lastDt, &w.clock.stiffnessDt, &w.clock.rings}) a.value(*seconds);
    a.value(w.clock.steadySteps);
    a.value(w.clock.stepCount);
    a.list(w.diary.touchingBefore);
    a.list(w.activity.pushed);
    a.list(w.activity.unsettled);
    a.list(w.diary.pending.end);
    a.list(w.diary.pending.woke);
    droppedMortar(a, w.diary.pending.mortar);
    a.list(w.diary.sensed);
  }

 private:
  template <class Archive, class List> static void droppedMortar(Archive& a, List& events) {
    length(a, events, sizeof(MortarId));
    for (auto& event : events) {
      for (auto* body : {&event.bodyA, &event.bodyB}) a.value(*body);
      a.value(event.mortar);
      a.value(event.pointWorld);
      a.choice(event.mode, MortarMode::crushing);
      a.value(event.energy);
      for (auto* flag : {&event.broken, &event.dropped}) a.flag(*flag);
    }
  }

  template <class Archive, class Def> static void definition(Archive& a, Def& d) {
    a.value(d.gravity);
    a.value(d.airDensity);
    a.flag(d.enableSleep);
    for (auto* number : {&d.sleepDelay, &d.hitEventSpeed, &d.hitEventImpulse}) a.value(*number);
    for (auto* number : {&d.threads, &d.maxBodies}) a.value(*number);
    a.choice(d.broadPhase, BroadPhaseMethod(kBroadPhaseMethodCount - 1));
    a.choice(d.integrator, Integrator(kIntegratorCount - 1));
    eachSetting(d.solver, [&](auto, auto& value, auto, auto) { a.value(value); });
  }

  // The length of a list of structures that are read field by field.
  template <class Archive, class List> static void length(Archive& a, List& list, std::size_t leastSize) {
    std::uint64_t n = a.count(list.size(), leastSize);
    if constexpr (Archive::kReading) list.resize(std::size_t(n));
  }

  template <class Archive, class Bodies> static void bodies(Archive& a, Bodies& b) {
    a.list(b.motion);
    a.list(b.still);
    length(a, b.data, kLeastSlot);
    length(a, b.shapes, sizeof(std::uint64_t));
    for (auto& list : b.shapes) a.list(list);
    for (auto& data : b.data) {
      a.flag(data.alive);
      a.value(data.generation);
      if (data.alive) body(a, data);
    }
    a.list(b.free_);
    a.value(b.nextOrder_);
    if constexpr (Archive::kReading) {
      b.mass.resize(b.data.size());
      for (const auto& data : b.data) b.count_ += data.alive;
    }
  }

  template <class Archive, class Data> static void body(Archive& a, Data& d) {
    a.choice(d.type, BodyType::dynamic);
    a.choice(d.activity, BodyActivity::fixed);
    for (auto* flag : {&d.quarantined, &d.enabled, &d.allowSleep, &d.steady.swings}) a.flag(*flag);
    a.choice(d.locks, kAllLocks);
    for (auto* number : {&d.gravityScale, &d.linearDamping, &d.angularDamping, &d.dragArea, &d.turnEnergy, &d.steady.dt,
                         &d.usualChange, &d.impactLoss})
      a.value(*number);
    for (auto* vector : {&d.force, &d.torque, &d.lastLinearVelocity, &d.lastAngularVelocity, &d.linearAcceleration,
                         &d.angularAcceleration, &d.surfaceVelocity, &d.steady.linear, &d.steady.angular})
      a.value(*vector);
    a.value(d.userData);
    a.value(d.order);
    optionalMass(a, d.givenMass, [](const MassProperties& mass) { return std::optional(mass); });
  }

  template <class Archive, class Mass, class Make> static void optionalMass(Archive& a, Mass& given, Make make) {
    bool any = bool(given);
    a.flag(any);
    if (!any) return;
    MassProperties mass;
    if constexpr (!Archive::kReading) mass = *given;
    a.value(mass);
    if constexpr (Archive::kReading) given = make(mass);
  }

  template <class Archive, class Shapes, class Around> static void shapes(Archive& a, Shapes& s, Around& around) {
    length(a, s.data, kLeastSlot);
    if constexpr (Archive::kReading) around.resize(s.data.size());
    for (std::size_t i = 0; i < s.data.size(); i++) {
      a.flag(s.data[i].alive);
      a.value(s.data[i].generation);
      if (!s.data[i].alive) continue;
      shape(a, s.data[i]);
      a.value(around[i].swept);
    }
    meshes(a, s);
    a.list(s.free_);
  }

  template <class Archive, class Data> static void shape(Archive& a, Data& s) {
    a.value(s.body);
    a.choice(s.def.type, ShapeType(kShapeTypeCount - 1));
    a.value(s.def.halfExtents);
    a.value(s.def.radius);
    if (s.def.type == ShapeType::cone) a.value(s.def.topRadius);
    a.value(s.def.halfHeight);
    a.list(s.def.vertices);
    a.value(s.def.local);
    auto& m = s.def.material;
    for (auto* number : {&m.density, &m.friction, &m.restitution, &m.rollingResistance, &m.hardness}) a.value(*number);
    for (auto* rule : {&m.frictionRule, &m.restitutionRule}) a.choice(*rule, CombineRule::maximum);
    a.value(s.def.filter);
    a.flag(s.def.sensor);
    a.value(s.def.userData);
    optionalMass(a, s.def.distribution,
                 [](const MassProperties& mass) { return std::make_shared<const MassProperties>(mass); });
  }

  // Each mesh once, however many shapes have it, in the order of the first of these shapes. Trees are built anew.
  template <class Archive, class Shapes> static void meshes(Archive& a, Shapes& s) {
    std::vector<std::shared_ptr<const MeshTree>> all;
    std::vector<std::uint32_t> numberOf;  // by shape; 0 = none
    if constexpr (!Archive::kReading)
      for (auto& shape : s.data) {
        std::uint32_t number = 0;
        if (shape.alive && shape.def.mesh) {
          number = std::uint32_t(std::find(all.begin(), all.end(), shape.def.mesh) - all.begin()) + 1;
          if (number > all.size()) all.push_back(shape.def.mesh);
        }
        numberOf.push_back(number);
      }
    a.list(numberOf);
    std::uint64_t n = a.count(all.size(), 2 * sizeof(std::uint64_t));
    for (std::uint64_t i = 0; i < n; i++) {
      std::vector<Vec3> vertices;
      std::vector<std::uint32_t> indices;
      if constexpr (!Archive::kReading) {
        vertices = all[i]->mesh().vertices();
        for (const TriangleMesh::Face& f : all[i]->mesh().faces())
          indices.insert(indices.end(), f.vertex, f.vertex + 3);
      }
      a.list(vertices);
      a.list(indices);
      if constexpr (Archive::kReading) {
        Result<TriangleMesh> mesh = TriangleMesh::create(vertices, indices);
        all.push_back(mesh ? std::make_shared<MeshTree>(MeshTree::build(std::move(mesh).value())) : nullptr);
      }
    }
    if constexpr (Archive::kReading)
      for (std::size_t i = 0; i < s.data.size() && i < numberOf.size(); i++)
        if (numberOf[i] > 0 && numberOf[i] <= all.size()) s.data[i].def.mesh = all[numberOf[i] - 1];
  }

  template <class Archive, class Hierarchies> static void hierarchy(Archive& a, Hierarchies& h) {
    a.flag(h.valid);
    length(a, h.levels, kLeastLevel);
    for (auto& level : h.levels) {
      a.list(level.clusters);
      a.list(level.clusterOf);
      a.list(level.bodies);
      a.list(level.sides);
    }
  }

  template <class Archive, class Islands, class Memory>
  static void islandList(Archive& a, Islands& list, [[maybe_unused]] Memory* memory) {
    [[maybe_unused]] std::uint64_t n = a.count(list.size(), kLeastIsland);
    if constexpr (Archive::kReading)
      for (std::uint64_t i = 0; i < n; i++) list.push_back(makeIsland(memory));
    for (auto& pointer : list) {
      auto& i = *pointer;
      a.list(i.bodies);
      a.list(i.partners);
      i.rows.eachKind([&](auto& kind) { kind.archive(a); });
      hierarchy(a, i.hierarchy);
      a.flag(i.facts.partnersMove);  // of an island that stays settled
      a.choice(i.ending, IslandEnding::settled);
      a.value(i.points);
      a.value(i.touchingPoints);
      a.list(i.placePoses);
      a.value(i.inPlaceTime);
      a.value(i.fastestLately);
      a.value(i.restTime);
    }
  }
};

std::vector<std::byte> World::snapshot() const {
  WriteArchive body;
  SnapshotArchive::world(body, *impl_);
  std::vector<std::byte> bytes = body.take();
  Header header;
  header.hash = hashOf(bytes);
  WriteArchive head;
  head.value(header);
  std::vector<std::byte> out = head.take();
  out.insert(out.end(), bytes.begin(), bytes.end());
  return out;
}

Status World::restore(std::span<const std::byte> snapshot) {
  if (Status open = impl_->openForChange("restore"); !open) return open;
  if (snapshot.size() < sizeof(Header))
    return badSnapshot("found " + std::to_string(snapshot.size()) + " bytes, expected at least " +
                       std::to_string(sizeof(Header)));
  Header header;
  std::memcpy(&header, snapshot.data(), sizeof header);
  std::span<const std::byte> rest = snapshot.subspan(sizeof header);
  if (header.magic != kMagic) return badSnapshot("these bytes are not a snapshot");
  if (header.layout != kLayout || header.recordSize != Rows::recordSize())
    return badSnapshot("made by another version (layout " + std::to_string(header.layout) + ", expected " +
                       std::to_string(kLayout) + ")");
  if (header.hash != hashOf(rest)) return badSnapshot("damaged or cut off (its checksum differs)");

  auto next = std::make_unique<Impl>();
  next->def.tasks = impl_->def.tasks;
  next->def.memory = impl_->def.memory;
  next->solve.memory.takeFrom(next->def.memory);
  ReadArchive archive(rest);
  SnapshotArchive::world(archive, *next);
  if (archive.failed() || !archive.atEnd()) return badSnapshot("its lists do not fit its length");
  next->registry.worldNumber = impl_->registry.worldNumber;
  if (Status sound = next->rebuild(); !sound) return badSnapshot(sound.error().message);
  next->solve.workers = std::make_unique<WorkerPool>(next->def.threads, next->def.tasks);
  next->diary.traceOptions = impl_->diary.traceOptions;
  next->contactFilter = impl_->contactFilter;
  next->preSolve = impl_->preSolve;
  next->askContactFilter();
  World candidate(std::move(next));
  std::vector<std::string> wrong = candidate.validate();
  if (!wrong.empty()) return badSnapshot(wrong.front());
  impl_ = std::move(candidate.impl_);
  return {};
}

}  // namespace brickfall
