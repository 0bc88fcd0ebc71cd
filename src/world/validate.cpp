// Every invariant of every part, for tests and for finding our bugs.
#include <algorithm>
#include <cmath>

#include "world/world_impl.h"

namespace brickfall {

namespace {

class Findings {
 public:
  void expect(bool holds, const std::string& text) {
    if (!holds && found_.size() < 100) found_.push_back(text);
  }
  std::vector<std::string> take() { return std::move(found_); }
  bool any() const { return !found_.empty(); }

 private:
  std::vector<std::string> found_;
};

std::string at(const char* what, std::size_t i) { return std::string(what) + " " + std::to_string(i); }

template <class List> bool ascending(const List& list) {
  return std::adjacent_find(list.begin(), list.end(), [](const auto& a, const auto& b) { return !(a < b); }) ==
         list.end();
}

void checkHierarchy(Findings& f, const Hierarchy& h, const Island& island, const std::string& name) {
  for (const Level& level : h.levels) {
    f.expect(level.clusterOf.size() == island.bodies.size() && level.bodies.size() == island.bodies.size(),
             name + ": a level does not hold every body");
    if (f.any()) return;
    for (std::uint32_t c : level.clusterOf) f.expect(c < level.clusters.size(), name + ": a body is in no cluster");
    for (std::uint32_t b : level.bodies)
      f.expect(b < island.bodies.size(), name + ": a cluster names a body that is not there");
    for (std::uint32_t s : level.sides) f.expect(s / 2 < island.rows.size(), name + ": a side names no row");
    if (f.any()) return;
    for (std::size_t n = 0; n < level.clusters.size(); n++) {
      const Cluster& c = level.clusters[n];
      f.expect(c.bodyBegin < c.bodyEnd && c.bodyEnd <= level.bodies.size() && c.sideBegin <= c.sideEnd &&
                   c.sideEnd <= level.sides.size(),
               name + ": a cluster's ranges are wrong");
      if (f.any()) return;
      for (std::uint32_t k = c.sideBegin; k < c.sideEnd; k++) {
        std::uint32_t own = 0;
        island.rows.at(level.sides[k] / 2, [&](const auto& kind, std::size_t row) {
          own = level.sides[k] % 2 == 1 ? kind.ends(row).b : kind.ends(row).a;
        });
        f.expect(own < island.bodies.size() && level.clusterOf[own] == n, name + ": a side is not of its cluster");
      }
    }
  }
  if (!h.levels.empty()) f.expect(h.levels.back().clusters.size() == 1, name + ": the top level is not one cluster");
}

}  // namespace

// Counts, indices and links: what must hold before anything may be followed.
std::vector<std::string> World::Impl::validateStructure() const {
  Findings f;
  std::size_t n = bodies.data.size(), m = shapes.data.size();
  f.expect(
      bodies.motion.size() == n && bodies.mass.size() == n && bodies.shapes.size() == n && bodies.still.size() == n,
      "bodies: lists of different lengths");
  f.expect(contacts.contacts.size() == contacts.geometry.size(), "contacts: lists of different lengths");
  if (f.any()) return f.take();
  int alive = 0;
  for (std::size_t i = 0; i < n; i++) {
    const BodyData& d = bodies.data[i];
    alive += d.alive;
    if (!d.alive) continue;
    f.expect(d.type <= BodyType::dynamic && d.activity <= BodyActivity::fixed, at("body", i) + ": unknown type");
    f.expect(!bodies.shapes[i].empty(), at("body", i) + ": no shapes");
    for (ShapeIndex s : bodies.shapes[i])
      f.expect(s < m && shapes.data[s].alive && shapes.data[s].body == i, at("body", i) + ": a shape is not its own");
  }
  f.expect(alive == bodies.count(), "bodies: wrong count");
  int dynamic = 0;
  for (const BodyData& d : bodies.data) dynamic += d.alive && d.type == BodyType::dynamic;
  f.expect(dynamic == dynamicBodies, "bodies: wrong count of dynamic ones");
  for (std::size_t i = 0; i < m; i++)
    if (shapes.data[i].alive)
      f.expect(shapes.data[i].body < n && bodies.data[shapes.data[i].body].alive &&
                   int(shapes.data[i].def.type) < kShapeTypeCount &&
                   (shapes.data[i].def.type != ShapeType::mesh ||
                    (shapes.data[i].def.mesh && bodies.data[shapes.data[i].body].type != BodyType::dynamic)),
               at("shape", i) + ": of no body");
  auto bodyFine = [&](BodyIndex b) { return b < n && bodies.data[b].alive; };
  for (const auto* list : {&contacts.pairs, &contacts.asleep}) {
    f.expect(ascending(*list), "pairs: not sorted, or twice");
    for (const CandidatePair& p : *list) {
      bool fine = p.shapeA < m && p.shapeB < m && shapes.data[p.shapeA].alive && shapes.data[p.shapeB].alive &&
                  shapes.data[p.shapeA].body == p.bodyA && shapes.data[p.shapeB].body == p.bodyB && bodyFine(p.bodyA) &&
                  bodyFine(p.bodyB) && !bodies.data[p.bodyA].quarantined && !bodies.data[p.bodyB].quarantined &&
                  (p.contact == kNoIndex || p.contact < contacts.contacts.size());
      f.expect(fine, "pairs: one names what is not there");
      f.expect(p.part < std::uint32_t(kMaxMeshManifolds) && (p.part == 0 || p.contact != kNoIndex),
               "pairs: a part too many, or without a contact");
      if (!fine || p.contact == kNoIndex) continue;
      const Contact& c = contacts.contacts[p.contact];
      f.expect(c.shapeA == p.shapeA && c.shapeB == p.shapeB && c.bodyA == p.bodyA && c.bodyB == p.bodyB,
               "pairs: the contact is another pair's");
      f.expect(c.count >= 1 && c.count <= 4, "contacts: a number of points that is not 1 .. 4");
    }
  }
  for (ContactIndex c : contacts.unused())
    f.expect(c < contacts.contacts.size(), "contacts: a free one that is not there");
  for (BodyIndex b : bodies.unused()) f.expect(b < n && !bodies.data[b].alive, "bodies: a free slot that is not free");
  for (ShapeIndex s : shapes.unused()) f.expect(s < m && !shapes.data[s].alive, "shapes: a free slot that is not free");
  for (BodyIndex b : awake)
    f.expect(bodyFine(b) && bodies.data[b].type == BodyType::dynamic, "awake: not a dynamic body");
  for (BodyIndex b : moving)
    f.expect(bodyFine(b) && bodies.data[b].type == BodyType::kinematic, "moving: not a kinematic body");
  f.expect(ascending(awake) && ascending(moving), "awake or moving: not sorted");
  for (const auto* list : {&islands.awake, &islands.asleep})
    for (const auto& island : *list) {
      f.expect(!island->bodies.empty() && ascending(island->bodies), "islands: bodies not sorted, or none");
      bool sized = island->rows.contacts.records.size() == island->rows.contacts.contactOf.size() &&
                   island->rows.contacts.starts.size() == island->rows.contacts.contactOf.size();
      f.expect(sized, "islands: lists of different lengths");
      for (BodyIndex b : island->bodies)
        f.expect(bodyFine(b) && bodies.data[b].type == BodyType::dynamic, "islands: not a dynamic body");
      for (BodyIndex b : island->partners) f.expect(bodyFine(b), "islands: a partner that is not there");
      for (ContactIndex c : island->rows.contacts.contactOf)
        f.expect(c < contacts.contacts.size(), "islands: a contact that is not there");
      bool current = list == &islands.asleep || (!contacts.changed && !membershipChanged);
      if (f.any()) return f.take();
      for (std::size_t k = 0; current && k < island->rows.contacts.contactOf.size(); k++) {
        const Contact& c = contacts.contacts[island->rows.contacts.contactOf[k]];
        f.expect(bodyFine(c.bodyA) && bodyFine(c.bodyB) && c.count >= 1 && c.count <= 4 &&
                     island->rows.contacts.records[k].contact == island->rows.contacts.contactOf[k],
                 "islands: a contact of other bodies, or of none");
      }
      std::size_t all = island->bodies.size() + island->partners.size();
      for (const ContactRecord& r : island->rows.contacts.records)
        f.expect(r.bodyA < all && r.bodyB < all && r.contact < contacts.contacts.size(),
                 "islands: a record names no body");
      if (f.any()) return f.take();
      checkHierarchy(f, island->byStrength, *island, "hierarchy by strength");
      checkHierarchy(f, island->byMechanism, *island, "hierarchy by mechanism");
    }
  for (BodyIndex b : islands.single)
    f.expect(bodyFine(b) && bodies.data[b].type == BodyType::dynamic, "islands: a single body that is not there");
  for (std::uint32_t i : islandOf)
    f.expect(i == kNoIndex || i < islands.awake.size(), "islandOf: an island that is not there");
  for (const auto* list : {&pushed, &unsettled}) {
    f.expect(ascending(*list), "pushed or unsettled: not sorted");
    for (BodyIndex b : *list) f.expect(bodyFine(b), "pushed or unsettled: a body that is not there");
  }
  for (const auto& pair : touchingBefore)
    f.expect(pair.first < n && pair.second < n, "touching: a body that is not there");
  return f.take();
}

std::vector<std::string> World::validate() const {
  const Impl& w = *impl_;
  Findings f;
  for (const std::string& text : w.validateStructure()) f.expect(false, text);
  if (f.any()) return f.take();
  for (const std::string& text : w.validateLinks()) f.expect(false, text);
  for (const std::string& text : w.broadPhase->validate()) f.expect(false, "broad phase: " + text);
  for (BodyIndex i = 0; i < w.bodies.slots(); i++) {
    if (!w.bodies.alive(i)) continue;
    const BodyMotion& m = w.bodies.motion[i];
    f.expect(isFinite(m.position) && isFinite(m.rotation) && isFinite(m.linearVelocity) && isFinite(m.angularVelocity),
             at("body", i) + ": not finite");
    double norm = m.rotation.x * m.rotation.x + m.rotation.y * m.rotation.y + m.rotation.z * m.rotation.z +
                  m.rotation.w * m.rotation.w;
    f.expect(std::fabs(norm - 1) < 1e-9, at("body", i) + ": its quaternion is not of unit length");
    bool listed = std::binary_search(w.awake.begin(), w.awake.end(), i);
    bool should = w.bodies.data[i].type == BodyType::dynamic && w.bodies.data[i].activity == BodyActivity::awake;
    f.expect(listed == should, at("body", i) + ": awake list and state differ");
    for (ShapeIndex s : w.bodies.shapes[i]) {
      if (w.shapes.data[s].proxy == kNoProxy) {
        f.expect(w.bodies.data[i].quarantined, at("shape", s) + ": not in the broad phase");
        continue;
      }
      const Aabb& kept = w.broadPhase->kept(w.shapes.data[s].proxy);
      f.expect(contains(kept, w.shapes.data[s].swept), at("shape", s) + ": its swept bounds are outside the kept ones");
      f.expect(contains(kept, bounds(w.shapes.data[s].geometry, w.shapes.worldPose(s, w.bodies))),
               at("shape", s) + ": outside its kept bounds");
    }
  }
  for (const auto* list : {&w.contacts.pairs, &w.contacts.asleep})
    for (const CandidatePair& p : *list) {
      if (p.contact == kNoIndex) continue;
      const Contact& c = w.contacts.contacts[p.contact];
      const ContactGeometry& g = w.contacts.geometry[p.contact];
      f.expect(std::fabs(lengthSquared(g.normal) - 1) < 1e-6 && std::fabs(dot(g.normal, g.tangent1)) < 1e-6,
               "contacts: a frame is not orthonormal");
      f.expect(isSound(c.points), "contacts: what points remember is out of range");
    }
  if (!w.membershipChanged && !w.contacts.changed) {
    std::size_t inIslands = w.islands.single.size();
    for (const auto& island : w.islands.awake) inIslands += island->bodies.size();
    f.expect(inIslands == w.awake.size(), "islands: not every awake body is in one");
  }
  return f.take();
}

}  // namespace brickfall
