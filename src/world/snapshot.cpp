// A world as bytes, and back: all that a step reads, so that a restored world goes on bit for bit. The tree of the broad
// phase is built anew: which contacts exist does not depend on its shape.
//
// Layout: magic, layout number, hash of the rest; the fields in the order below, as this machine has them in memory.
#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "brickfall/geometry/mesh_tree.h"
#include "world/archive.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

constexpr std::uint64_t kMagic = 0x30504e5346424b42ull;
constexpr std::uint32_t kLayout = 3;

struct Header {
  std::uint64_t magic = kMagic;
  std::uint32_t layout = kLayout;
  std::uint32_t contactSize = sizeof(Contact);  // tells builds with another memory layout apart
  std::uint64_t hash = 0;
};

std::uint64_t hashOf(std::span<const std::byte> bytes) {
  Hash hash;
  for (std::byte b : bytes) hash.addByte(std::uint8_t(b));
  return hash.value();
}

template <class Archive, class Vector> void nested(Archive& archive, Vector& lists) {
  std::uint64_t n = archive.count(lists.size(), sizeof(std::uint64_t));
  if constexpr (Archive::kReading) lists.resize(std::size_t(n));
  for (auto& list : lists) archive.list(list);
}

}  // namespace

// Sees the private lists of the sets.
class SnapshotArchive {
 public:
  template <class Archive, class Impl> static void world(Archive& a, Impl& w) {
    a.value(w.def);
    bodies(a, w.bodies);
    shapes(a, w.shapes);
    contacts(a, w.contacts);
    islandList(a, w.islands.awake, &w.stepMemory);
    islandList(a, w.islands.asleep, &w.stepMemory);
    a.list(w.islands.single);
    a.list(w.awake);
    a.list(w.moving);
    a.list(w.islandOf);
    a.value(w.membershipChanged);
    a.value(w.time);
    a.value(w.lastDt);
    a.value(w.stepCount);
    a.list(w.touchingBefore);
    a.list(w.pushed);
    a.list(w.unsettled);
    a.list(w.pending.end);
    a.list(w.pending.woke);
    a.value(w.dynamicBodies);
  }

 private:
  template <class Archive, class Bodies> static void bodies(Archive& a, Bodies& b) {
    a.list(b.motion);
    a.list(b.mass);
    a.list(b.data);
    nested(a, b.shapes);
    a.list(b.still);
    a.list(b.free_);
    a.value(b.count_);
    a.value(b.nextOrder_);
  }

  template <class Archive, class Shapes> static void shapes(Archive& a, Shapes& s) {
    std::uint64_t n = a.count(s.data.size(), sizeof(std::uint64_t));
    if constexpr (Archive::kReading) s.data.resize(std::size_t(n));
    for (auto& shape : s.data) {
      a.value(shape.alive);
      a.value(shape.generation);
      a.value(shape.body);
      a.value(shape.def.type);
      a.value(shape.def.halfExtents);
      a.value(shape.def.radius);
      a.value(shape.def.halfHeight);
      a.list(shape.def.vertices);
      a.value(shape.def.local);
      a.value(shape.def.material);
      a.value(shape.def.filter);
      a.value(shape.def.userData);
      a.value(shape.inCentreFrame);
      a.value(shape.innerRadius);
      a.value(shape.middle);
      a.value(shape.swept);
    }
    meshes(a, s);
    a.list(s.free_);
  }

  // Each mesh once, however many shapes have it, in the order of the first of them. Trees are built anew.
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
        for (const TriangleMesh::Face& f : all[i]->mesh().faces()) indices.insert(indices.end(), f.vertex, f.vertex + 3);
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

  template <class Archive, class Contacts> static void contacts(Archive& a, Contacts& c) {
    a.list(c.pairs);
    a.list(c.asleep);
    a.list(c.contacts);
    a.list(c.geometry);
    a.value(c.changed);
    a.list(c.free_);
  }

  template <class Archive, class Hierarchies> static void hierarchy(Archive& a, Hierarchies& h) {
    std::uint64_t n = a.count(h.levels.size(), sizeof(std::uint64_t));
    if constexpr (Archive::kReading) h.levels.resize(std::size_t(n));
    for (auto& level : h.levels) {
      a.list(level.clusters);
      a.list(level.clusterOf);
      a.list(level.bodies);
      a.list(level.sides);
    }
  }

  template <class Archive, class Islands, class Memory>
  static void islandList(Archive& a, Islands& list, [[maybe_unused]] Memory* memory) {
    std::uint64_t n = a.count(list.size(), sizeof(std::uint64_t));
    if constexpr (Archive::kReading) {
      list.clear();
      for (std::uint64_t i = 0; i < n; i++) list.push_back(makeIsland(memory));
    }
    for (auto& pointer : list) {
      auto& i = *pointer;
      a.list(i.bodies);
      a.list(i.contacts);
      a.list(i.partners);
      a.list(i.records);
      a.list(i.starts);
      hierarchy(a, i.byStrength);
      hierarchy(a, i.byMechanism);
      for (auto* flag : {&i.hierarchiesValid, &i.mechanismValid, &i.grounded, &i.partnersMove, &i.slow, &i.resting,
                         &i.settled, &i.allowSleep})
        a.value(*flag);
      a.value(i.points);
      a.value(i.touchingPoints);
      a.list(i.heldPoses);
      a.value(i.heldTime);
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

namespace {

Error badSnapshot(const std::string& why) { return {ErrorCode::badFormat, "snapshot: " + why}; }

}  // namespace

Status World::restore(std::span<const std::byte> snapshot) {
  if (Status open = impl_->openForChange("restore"); !open) return open;
  if (snapshot.size() < sizeof(Header))
    return badSnapshot("found " + std::to_string(snapshot.size()) + " bytes, expected at least " +
                       std::to_string(sizeof(Header)));
  Header header;
  std::memcpy(&header, snapshot.data(), sizeof header);
  std::span<const std::byte> rest = snapshot.subspan(sizeof header);
  if (header.magic != kMagic) return badSnapshot("these bytes are not a snapshot");
  if (header.layout != kLayout || header.contactSize != sizeof(Contact))
    return badSnapshot("made by another version (layout " + std::to_string(header.layout) + ", expected " +
                       std::to_string(kLayout) + ")");
  if (header.hash != hashOf(rest)) return badSnapshot("damaged or cut off (its checksum differs)");

  auto next = std::make_unique<Impl>();
  ReadArchive archive(rest);
  SnapshotArchive::world(archive, *next);
  if (archive.failed() || !archive.atEnd()) return badSnapshot("its lists do not fit its length");
  next->worldNumber = impl_->worldNumber;
  Status sound = next->rebuild();
  if (!sound) return sound;
  next->pool = std::make_unique<WorkerPool>(next->def.threads);
  next->traceOptions = impl_->traceOptions;
  impl_ = std::move(next);
  return {};
}

// After reading: hulls and the tree; then every invariant.
Status World::Impl::rebuild() {
  if (Status fine = checkWorld(def); !fine) return badSnapshot(fine.error().message);
  std::vector<std::string> wrong = validateStructure();
  if (!wrong.empty()) return badSnapshot(wrong.front());
  for (BodyIndex i = 0; i < bodies.slots(); i++) {
    const BodyMotion& m = bodies.motion[i];
    bool finite =
        isFinite(m.position) && isFinite(m.rotation) && isFinite(m.linearVelocity) && isFinite(m.angularVelocity);
    if (bodies.alive(i) && !finite) return badSnapshot("a body's motion is not finite");
  }
  for (ShapeIndex i = 0; i < shapes.slots(); i++) {
    ShapeData& s = shapes.data[i];
    if (!s.alive) continue;
    if (!isFinite(s.inCentreFrame.position) || !isFinite(s.inCentreFrame.rotation) || !isFinite(s.def.halfExtents))
      return badSnapshot("a shape is not finite");
    s.geometry.type = s.def.type;
    s.geometry.halfExtents = s.def.halfExtents;
    s.geometry.radius = s.def.radius;
    s.geometry.halfHeight = s.def.halfHeight;
    s.geometry.mesh = s.def.mesh.get();
    if (s.def.type == ShapeType::hull) {
      Result<Hull> hull = buildHull(std::span<const Vec3>(s.def.vertices));
      if (!hull) return badSnapshot("a hull can't be built: " + hull.error().message);
      s.hull = std::make_unique<Hull>(std::move(hull).value());
      s.geometry.hull = s.hull.get();
    }
    // A hit may have thrown the body out of the bounds swept before it.
    if (!bodies.data[s.body].quarantined) addProxy(i, merged(bounds(s.geometry, shapes.worldPose(i, bodies)), s.swept));
  }
  return {};
}

}  // namespace brickfall
