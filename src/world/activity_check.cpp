// Invariants of the lists of awake bodies and of the islands: each body is in one island at most, and each island has
// the contacts of its bodies.
#include <algorithm>

#include "world/activity.h"

namespace brickfall {

namespace {

void checkHierarchy(Findings& f, const Hierarchy& h, const Island& island, const Ties& ties) {
  f.expect(!h.valid || h.levels.size() >= (island.bodies.size() > 1 ? 2 : 1), "hierarchy: a level is missing");
  const Level* finer = nullptr;
  for (const Level& level : h.levels) {
    f.expect(level.clusterOf.size() == island.bodies.size() && level.bodies.size() == island.bodies.size(),
             "hierarchy: a level does not hold every body");
    if (f.any()) return;
    for (std::uint32_t c : level.clusterOf) f.expect(c < level.clusters.size(), "hierarchy: a body is in no cluster");
    for (std::uint32_t b : level.bodies)
      f.expect(b < island.bodies.size(), "hierarchy: a cluster names a body that is not there");
    for (std::uint32_t s : level.sides) f.expect(s / 2 < island.rows.size(), "hierarchy: a side names no row");
    if (f.any()) return;
    for (std::size_t n = 0; n < level.clusters.size(); n++) {
      const Cluster& c = level.clusters[n];
      f.expect(c.bodyBegin < c.bodyEnd && c.bodyEnd <= level.bodies.size() && c.sideBegin <= c.sideEnd &&
                   c.sideEnd <= level.sides.size(),
               "hierarchy: a cluster's ranges are wrong");
      if (f.any()) return;
      for (std::uint32_t k = c.sideBegin; k < c.sideEnd; k++) {
        std::uint32_t own = 0;
        island.rows.at(level.sides[k] / 2, [&](const auto& kind, std::size_t row) {
          const RowEnds ends = kind.endsIn(island, ties, row);
          own = level.sides[k] % 2 == 1 ? ends.b : ends.a;
        });
        if (own == kNoIndex) continue;  // of a tie that has ended: the island is made anew
        f.expect(own < island.bodies.size() && level.clusterOf[own] == n, "hierarchy: a side is not of its cluster");
      }
      bool own = true;
      for (std::uint32_t k = c.bodyBegin; k < c.bodyEnd; k++) own = own && level.clusterOf[level.bodies[k]] == n;
      f.expect(own, "hierarchy: a cluster names another's body");
    }
    bool whole = true;
    for (std::size_t n = 0; finer && n < finer->clusters.size(); n++) {
      const Cluster& c = finer->clusters[n];
      const std::uint32_t into = level.clusterOf[finer->bodies[c.bodyBegin]];
      for (std::uint32_t k = c.bodyBegin; k < c.bodyEnd; k++)
        whole = whole && level.clusterOf[finer->bodies[k]] == into;
    }
    f.expect(whole, "hierarchy: a cluster was torn apart");
    if (f.any()) return;
    finer = &level;
  }
  if (!h.levels.empty()) f.expect(h.levels.back().clusters.size() == 1, "hierarchy: the top level is not one cluster");
}

class LinkCheck {
 public:
  LinkCheck(Findings& f, const Activity& activity, const BodySet& bodies, const Ties& ties)
      : f_(f), a_(activity), bodies_(bodies), ties_(ties), islandOf_(bodies.slots(), kNoIndex) {}

  void run() {
    checkLists();
    checkIslands();
    checkMembership();
  }

 private:
  bool dynamic(BodyIndex body) const { return bodies_.data[body].type == BodyType::dynamic; }
  bool activity(BodyIndex body, BodyActivity is) const { return bodies_.data[body].activity == is; }

  void checkLists() {
    for (BodyIndex i = 0; i < bodies_.slots(); i++) {
      const BodyData& d = bodies_.data[i];
      if (!d.alive) continue;
      bool active = d.activity == BodyActivity::awake || d.activity == BodyActivity::asleep;
      f_.expect(active == (d.type == BodyType::dynamic && bodies_.takesPart(i)), "bodies: activity and type differ");
      bool listed = std::binary_search(a_.awake.begin(), a_.awake.end(), i);
      f_.expect(listed == (dynamic(i) && activity(i, BodyActivity::awake)), "body", i, "awake list and state differ");
      f_.expect(
          std::binary_search(a_.moving.begin(), a_.moving.end(), i) == (bodies_.isDriven(i) && bodies_.takesPart(i)),
          "moving: not the kinematic bodies with a velocity");
    }
    for (BodyIndex body : a_.pushed) f_.expect(dynamic(body) && bodies_.takesPart(body), "pushed: not a dynamic body");
    for (BodyIndex body : a_.unsettled) f_.expect(!dynamic(body), "unsettled: a dynamic body");
  }

  // Each body in one island at most; the facts that an island holds about itself. Islands are numbered through both
  // lists.
  void checkIslands() {
    BodyIndex last = 0;
    for (std::size_t n = 0; n < a_.islands.awake.size(); n++) {
      const Island& island = *a_.islands.awake[n];
      f_.expect(n == 0 || last < island.key(), "islands: not in order");
      last = island.key();
      checkIsland(island, false);
    }
    for (const auto& island : a_.islands.asleep) checkIsland(*island, true);
  }

  void checkIsland(const Island& island, bool asleep) {
    for (BodyIndex body : island.bodies) {
      f_.expect(islandOf_[body] == kNoIndex, "islands: a body is in two");
      f_.expect(activity(body, BodyActivity::asleep) == asleep, "islands: awake and asleep are mixed up");
      islandOf_[body] = std::uint32_t(islands_.size());
    }
    islands_.push_back(&island);
    bool fine = island.points >= island.touchingPoints && island.touchingPoints >= 0 &&
                island.points <= island.rows.mostPoints() && island.inPlaceTime >= 0 && island.fastestLately >= 0 &&
                island.restTime >= 0;
    f_.expect(fine, "islands: a count or a time is wrong");
    for (BodyIndex body : island.partners) f_.expect(!dynamic(body), "islands: a partner is a dynamic body");
    island.rows.eachKind([&](const auto& kind) { kind.check(f_, island, ties_, asleep || current_); });
  }

  // The rows of an island are the links of its bodies, kind by kind in the order of the links.
  void checkMembership() {
    std::size_t awakeCount = a_.islands.awake.size();
    std::vector<Rows::Counts> next(islands_.size());
    auto follow = [&](std::size_t first, std::size_t end) {
      return [this, &next, first, end](const Link& link) {
        std::uint32_t a = islandOf_[link.bodyA], b = islandOf_[link.bodyB], n = dynamic(link.bodyA) ? a : b;
        bool both = dynamic(link.bodyA) && dynamic(link.bodyB);
        bool fine = n >= first && n < end && (!both || a == b);
        if (fine) fine = islands_[n]->rows.names(link, next[n][std::size_t(link.kind)]++);
        f_.expect(fine, "islands: rows are not the links of its bodies");
      };
    };
    auto whole = [&](std::size_t first, std::size_t end) {
      for (std::size_t n = first; n < end; n++)
        f_.expect(next[n] == islands_[n]->rows.counts(), "islands: a row is of no link");
    };
    if (current_) {
      ties_.eachAwake(follow(0, awakeCount));
      whole(0, awakeCount);
    }
    ties_.eachAsleep(follow(awakeCount, islands_.size()));
    whole(awakeCount, islands_.size());
    std::vector<BodyIndex> single;
    for (BodyIndex i = 0; i < bodies_.slots(); i++) {
      if (!bodies_.data[i].alive) continue;
      if (activity(i, BodyActivity::asleep)) f_.expect(islandOf_[i] != kNoIndex, "islands: a body sleeps in none");
      if (activity(i, BodyActivity::awake) && islandOf_[i] == kNoIndex) single.push_back(i);
    }
    if (!current_) return;
    f_.expect(a_.islands.single == single, "islands: single bodies are not those without one");
    std::vector<std::uint32_t> awakeIslandOf = islandOf_;
    for (std::uint32_t& n : awakeIslandOf) n = n < awakeCount ? n : kNoIndex;
    f_.expect(a_.islandOf == awakeIslandOf, "islandOf: not the islands that are there");
  }

  Findings& f_;
  const Activity& a_;
  const BodySet& bodies_;
  const Ties& ties_;
  bool current_ = a_.current(ties_);     // islands match the contacts
  std::vector<std::uint32_t> islandOf_;  // by body, in islands_
  std::vector<const Island*> islands_;   // awake, then asleep
};

}  // namespace

void Activity::checkStructure(Findings& f, const BodySet& bodies, const Ties& ties) const {
  auto is = [&](BodyIndex body, BodyType type) { return bodies.alive(body) && bodies.data[body].type == type; };
  for (BodyIndex b : awake) f.expect(is(b, BodyType::dynamic), "awake: not a dynamic body");
  for (BodyIndex b : moving) f.expect(is(b, BodyType::kinematic), "moving: not a kinematic body");
  f.expect(isAscending(awake) && isAscending(moving), "awake or moving: not sorted");
  for (const auto* list : {&islands.awake, &islands.asleep})
    for (const auto& island : *list) {
      f.expect(!island->bodies.empty() && isAscending(island->bodies), "islands: bodies not sorted, or none");
      for (BodyIndex b : island->bodies) f.expect(is(b, BodyType::dynamic), "islands: not a dynamic body");
      for (BodyIndex b : island->partners) f.expect(bodies.alive(b), "islands: a partner that is not there");
      const bool now = list == &islands.asleep || current(ties);
      island->rows.eachKind([&](const auto& kind) { kind.checkStructure(f, *island, ties, bodies, now); });
      if (!f.any()) checkHierarchy(f, island->hierarchy, *island, ties);
      if (f.any()) return;
    }
  for (BodyIndex b : islands.single) f.expect(is(b, BodyType::dynamic), "islands: a single body that is not there");
  for (std::uint32_t i : islandOf)
    f.expect(i == kNoIndex || i < islands.awake.size(), "islandOf: an island that is not there");
  for (const auto* list : {&pushed, &unsettled}) {
    f.expect(isAscending(*list), "pushed or unsettled: not sorted");
    for (BodyIndex b : *list) f.expect(bodies.alive(b), "pushed or unsettled: a body that is not there");
  }
}

void Activity::check(Findings& f, const BodySet& bodies, const Ties& ties) const {
  LinkCheck(f, *this, bodies, ties).run();
}

}  // namespace brickfall
