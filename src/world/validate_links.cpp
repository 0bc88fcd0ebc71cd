// Invariants between the parts of a world, told exactly: which slot is free, which list a body stands in, whose contact a
// contact is, what an island consists of. World::validate() asks for them in tests; a snapshot that is restored must
// fulfil them, whoever made it, because the step follows these links without looking.
#include <algorithm>
#include <cmath>

#include "brickfall/limits.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

constexpr std::uint8_t kUnseen = 0, kSeen = 1;

}  // namespace

class World::Impl::LinkChecks {
 public:
  explicit LinkChecks(const World::Impl& world)
      : w_(world),
        current_(!world.contacts.changed && !world.membershipChanged),
        islandOf_(world.bodies.slots(), kNoIndex) {}

  std::vector<std::string> run() {
    checkBodies();
    checkShapes();
    checkPairs();
    checkContacts();
    checkIslands();
    checkMembership();
    checkLists();
    return std::move(found_);
  }

 private:
  void expect(bool holds, const char* text) {
    if (!holds && (found_.empty() || found_.back() != text)) found_.push_back(text);
  }
  bool dynamic(BodyIndex body) const { return w_.bodies.data[body].type == BodyType::dynamic; }
  bool activity(BodyIndex body, BodyActivity is) const { return w_.bodies.data[body].activity == is; }

  template <class Alive> void checkFree(const std::vector<std::uint32_t>& free, std::size_t slots, Alive alive) {
    std::vector<std::uint8_t> seen(slots, kUnseen);
    std::size_t dead = 0;
    for (std::size_t i = 0; i < slots; i++) dead += !alive(i);
    bool exact = free.size() == dead;
    for (std::uint32_t slot : free) {
      exact = exact && slot < slots && !alive(slot) && seen[slot] == kUnseen;
      if (slot < slots) seen[slot] = kSeen;
    }
    expect(exact, "slots: the free ones are not those listed as free");
  }

  void checkBodies() {
    const BodySet& b = w_.bodies;
    // A slot whose generations are used up is neither alive nor free.
    checkFree(b.unused(), b.slots(), [&](std::size_t i) { return b.data[i].alive || b.data[i].generation == 0xffff; });
    std::vector<std::uint64_t> orders;
    for (BodyIndex i = 0; i < b.slots(); i++) {
      const BodyData& d = b.data[i];
      expect(b.still[i] <= 1, "bodies: still is neither 0 nor 1");
      if (!d.alive) continue;
      orders.push_back(d.order);
      expect(d.order > 0 && d.order < b.nextOrder(), "bodies: an order of creation that was not given yet");
      bool active = d.activity == BodyActivity::awake || d.activity == BodyActivity::asleep;
      expect(active == (d.type == BodyType::dynamic && !d.quarantined), "bodies: activity and type differ");
      bool moves = w_.moves(i) && !d.quarantined;
      expect(std::binary_search(w_.moving.begin(), w_.moving.end(), i) == moves,
             "moving: not the kinematic bodies with a velocity");
      const BodyMotion& m = b.motion[i];
      bool rests = m.linearVelocity == Vec3{} && m.angularVelocity == Vec3{};
      expect(d.type != BodyType::fixed || rests, "bodies: a fixed one has a velocity");
    }
    std::sort(orders.begin(), orders.end());
    expect(std::adjacent_find(orders.begin(), orders.end()) == orders.end(), "bodies: two were created at once");
  }

  void checkShapes() {
    const ShapeSet& s = w_.shapes;
    checkFree(s.unused(), s.slots(), [&](std::size_t i) { return s.data[i].alive || s.data[i].generation == 0xffff; });
    std::size_t alive = 0, listed = 0;
    for (const ShapeData& shape : s.data) alive += shape.alive;
    std::vector<std::uint8_t> seen(s.slots(), kUnseen);
    for (BodyIndex i = 0; i < w_.bodies.slots(); i++) {
      expect(w_.bodies.data[i].alive || w_.bodies.shapes[i].empty(), "bodies: a free slot has shapes");
      for (ShapeIndex shape : w_.bodies.shapes[i]) {
        expect(seen[shape] == kUnseen, "shapes: one is listed twice");
        seen[shape] = kSeen;
        listed++;
        bool plane = s.data[shape].def.type == ShapeType::plane;
        expect(!plane || w_.bodies.data[i].type == BodyType::fixed, "shapes: a plane on a body that can move");
      }
    }
    expect(alive == listed, "shapes: one is of no body");
  }

  void checkPairs() {
    const ContactSet& c = w_.contacts;
    std::vector<std::uint8_t> used(c.contacts.size(), kUnseen);
    for (const auto* list : {&c.pairs, &c.asleep})
      for (const CandidatePair& p : *list) {
        expect(p.shapeA < p.shapeB && p.bodyA != p.bodyB && (dynamic(p.bodyA) || dynamic(p.bodyB)),
               "pairs: shapes that can't meet");
        bool mesh = w_.shapes.data[p.shapeA].def.type == ShapeType::mesh ||
                    w_.shapes.data[p.shapeB].def.type == ShapeType::mesh;
        expect(p.part == 0 || mesh, "pairs: a part of what is no mesh");
        if (p.contact == kNoIndex) continue;
        expect(used[p.contact] == kUnseen, "pairs: two have the same contact");
        used[p.contact] = kSeen;
      }
    checkFree(c.unused(), c.contacts.size(), [&](std::size_t i) { return used[i] == kSeen; });
    for (std::size_t i = 0; i < c.contacts.size(); i++)
      expect((c.contacts[i].count > 0) == (used[i] == kSeen), "contacts: one with points is of no pair");
    for (const CandidatePair& p : c.asleep) {
      expect(!std::binary_search(c.pairs.begin(), c.pairs.end(), p), "pairs: one is both awake and asleep");
      for (BodyIndex body : {p.bodyA, p.bodyB})
        expect(!activity(body, BodyActivity::awake) && !w_.moves(body), "pairs: one asleep names a body that is not");
    }
  }

  // What a contact says of its shapes, and its frame.
  void checkContacts() {
    for (std::size_t i = 0; i < w_.contacts.contacts.size(); i++) {
      const Contact& c = w_.contacts.contacts[i];
      if (c.count == 0) continue;
      const Material &a = w_.shapes.data[c.shapeA].def.material, &b = w_.shapes.data[c.shapeB].def.material;
      double inverseMass = w_.bodies.mass[c.bodyA].invMass + w_.bodies.mass[c.bodyB].invMass;
      expect(c.friction == float(mixFriction(a, b)) && c.restitution == float(mixRestitution(a, b)) &&
                 c.effectiveMass == float(1 / inverseMass) && c.weakSteps >= 0 && c.weakSteps <= kWeakHold,
             "contacts: a constant is not that of its bodies");
      const ContactGeometry& g = w_.contacts.geometry[i];
      expect(std::fabs(lengthSquared(g.normal) - 1) < 1e-6 && std::fabs(lengthSquared(g.tangent1) - 1) < 1e-6 &&
                 std::fabs(dot(g.normal, g.tangent1)) < 1e-6,
             "contacts: a frame is not orthonormal");
    }
  }

  // Each body in one island at most; what an island says of itself. Islands are numbered through both lists.
  void checkIslands() {
    BodyIndex last = 0;
    for (std::size_t n = 0; n < w_.islands.awake.size(); n++) {
      const Island& island = *w_.islands.awake[n];
      expect(n == 0 || last < island.key(), "islands: not in order");
      last = island.key();
      checkIsland(island, false);
    }
    for (const auto& island : w_.islands.asleep) checkIsland(*island, true);
  }

  void checkIsland(const Island& island, bool asleep) {
    for (BodyIndex body : island.bodies) {
      expect(islandOf_[body] == kNoIndex, "islands: a body is in two");
      expect(activity(body, BodyActivity::asleep) == asleep, "islands: awake and asleep are mixed up");
      islandOf_[body] = std::uint32_t(islands_.size());
    }
    islands_.push_back(&island);
    bool fine = island.points >= island.touchingPoints && island.touchingPoints >= 0 &&
                std::size_t(island.points) <= 4 * island.rows.contacts.contactOf.size() && island.heldTime >= 0 &&
                island.restTime >= 0;
    expect(fine, "islands: a count or a time is wrong");
    for (BodyIndex body : island.partners) expect(!dynamic(body), "islands: a partner is a dynamic body");
    for (std::size_t k = 0; k < island.rows.contacts.contactOf.size(); k++) {
      // Until islands are built anew a contact's slot may be empty, or another's.
      const Contact& c = w_.contacts.contacts[island.rows.contacts.contactOf[k]];
      bool ours = c.count > 0 && !c.born;
      expect(ours || (!asleep && !current_), "islands: a contact is gone");
      const ContactRecord& r = island.rows.contacts.records[k];
      if (ours)
        expect(bodyOf(island, r.bodyA) == c.bodyA && bodyOf(island, r.bodyB) == c.bodyB &&
                   r.contact == island.rows.contacts.contactOf[k],
               "islands: a record names other bodies than its contact");
    }
  }

  static BodyIndex bodyOf(const Island& island, std::uint32_t local) {
    std::size_t own = island.bodies.size();
    return local < own ? island.bodies[local] : island.partners[local - own];
  }

  // The rows of an island are those of the links of its bodies, kind by kind in their order.
  void checkMembership() {
    std::size_t awakeCount = w_.islands.awake.size();
    std::vector<Rows::Counts> next(islands_.size());
    const LinkSet links(w_.contacts);
    auto follow = [&](std::size_t first, std::size_t end) {
      return [this, &next, first, end](const Link& link) {
        std::uint32_t a = islandOf_[link.bodyA], b = islandOf_[link.bodyB], n = dynamic(link.bodyA) ? a : b;
        bool both = dynamic(link.bodyA) && dynamic(link.bodyB);
        bool fine = n >= first && n < end && (!both || a == b);
        if (fine) fine = islands_[n]->rows.names(link, next[n][std::size_t(link.kind)]++);
        expect(fine, "islands: rows are not the links of its bodies");
      };
    };
    auto whole = [&](std::size_t first, std::size_t end) {
      for (std::size_t n = first; n < end; n++)
        expect(next[n] == islands_[n]->rows.counts(), "islands: a row is of no link");
    };
    if (current_) {
      links.eachAwake(follow(0, awakeCount));
      whole(0, awakeCount);
    }
    links.eachAsleep(follow(awakeCount, islands_.size()));
    whole(awakeCount, islands_.size());
    std::vector<BodyIndex> single;
    for (BodyIndex i = 0; i < w_.bodies.slots(); i++) {
      if (!w_.bodies.data[i].alive) continue;
      if (activity(i, BodyActivity::asleep)) expect(islandOf_[i] != kNoIndex, "islands: a body sleeps in none");
      if (activity(i, BodyActivity::awake) && islandOf_[i] == kNoIndex) single.push_back(i);
    }
    if (!current_) return;
    expect(w_.islands.single == single, "islands: single bodies are not those without one");
    std::vector<std::uint32_t> awakeIslandOf = islandOf_;
    for (std::uint32_t& n : awakeIslandOf) n = n < awakeCount ? n : kNoIndex;
    expect(w_.islandOf == awakeIslandOf, "islandOf: not the islands that are there");
  }

  void checkLists() {
    for (BodyIndex body : w_.pushed) expect(dynamic(body), "pushed: not a dynamic body");
    for (BodyIndex body : w_.unsettled) expect(!dynamic(body), "unsettled: a dynamic body");
    const auto& touching = w_.touchingBefore;
    expect(std::is_sorted(touching.begin(), touching.end()) &&
               std::adjacent_find(touching.begin(), touching.end()) == touching.end(),
           "touching: not sorted, or twice");
    for (const BodyPair& pair : touching)
      expect(pair.first < pair.second && w_.bodies.alive(pair.first) && w_.bodies.alive(pair.second),
             "touching: a body that is not there");
    expect(w_.time >= 0 && std::isfinite(w_.time) && w_.lastDt >= 0 && w_.lastDt <= limits::kLongestTimeStep,
           "time: out of range");
  }

  const World::Impl& w_;
  bool current_;                         // islands are those of the contacts
  std::vector<std::uint32_t> islandOf_;  // by body, in islands_
  std::vector<const Island*> islands_;   // awake, then asleep
  std::vector<std::string> found_;
};

std::vector<std::string> World::Impl::validateLinks() const { return LinkChecks(*this).run(); }

}  // namespace brickfall
