// Ties of one kind that a program makes and destroys, by slot; a slot that is free is used again, with the next
// generation. Those that tie something are in one of two lists, awake or asleep. A tie has:
//
//   alive, generation, born, idle     idle: it ties nothing, since neither body is dynamic, or it is broken
//   bodyA, bodyB, order               order: grows with creation
//   collides()                        its bodies may collide with each other
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "dynamics/link.h"

namespace brickfall {

template <class Tie, LinkKind kKind> class LastingTies {
 public:
  using Index = std::uint32_t;
  static constexpr LinkKind kLink = kKind;
  bool has(Index tie) const { return tie < slots.size() && slots[tie].alive; }
  bool any() const { return !awake_.empty() || !asleep_.empty(); }

  Index create(const Tie& tie) {
    changed = true;
    Index index = Index(slots.size());
    std::uint16_t generation = 1;
    if (!free_.empty()) {
      index = free_.back();
      free_.pop_back();
      generation = std::uint16_t(slots[index].generation + 1);
    } else {
      grow(slots);
      slots.emplace_back();
    }
    slots[index] = tie;
    slots[index].alive = slots[index].born = true;
    slots[index].generation = generation;
    slots[index].order = nextOrder_++;
    insertAscending(awake_, index);
    for (auto* list : {&awake_, &asleep_}) list->reserve(slots.capacity());  // all may fall asleep or wake at once
    if (!tie.collides()) part(index);
    return index;
  }
  void destroy(Index index) {
    changed = true;
    Tie& tie = slots[index];
    for (auto* list : {&awake_, &asleep_}) std::erase(*list, index);
    if (!tie.collides()) unpart(index);
    const std::uint16_t generation = tie.generation;
    tie = {};
    tie.generation = generation;
    free_.push_back(index);
  }
  std::vector<Index> inOrder() const {  // of creation
    std::vector<Index> out;
    for (Index i = 0; i < slots.size(); i++)
      if (slots[i].alive) out.push_back(i);
    std::sort(out.begin(), out.end(), [&](Index a, Index b) { return slots[a].order < slots[b].order; });
    return out;
  }

  // --- functions of every kind of tie (contact_set.h)
  template <class Visit> void eachAwake(Visit&& visit) const { eachLink(awake_, visit); }
  template <class Visit> void eachAsleep(Visit&& visit) const { eachLink(asleep_, visit); }
  bool anyAsleep() const { return !asleep_.empty(); }
  template <class Leaves> void sleepWhere(Leaves leaves) { move(awake_, asleep_, leaves); }
  template <class Wakes> void wakeWhere(Wakes wakes) { move(asleep_, awake_, wakes); }
  void dropOf(BodyIndex body) {
    if (slots.size() == free_.size()) return;
    for (Index i = 0; i < slots.size(); i++)
      if (slots[i].alive && (slots[i].bodyA == body || slots[i].bodyB == body)) destroy(i);
  }
  // A tie that ends with the step keeps its bodies apart no more, from where its island was stored on.
  bool mayCollide(BodyIndex a, BodyIndex b) const {
    return everyTie(a, b, [](const Tie& tie) { return tie.endsNow(); });
  }
  // Nothing keeps the two apart from one step to the next.
  bool strangers(BodyIndex a, BodyIndex b) const {
    return everyTie(a, b, [](const Tie&) { return false; });
  }
  void keepRoom(std::size_t) {}  // such ties come between steps only
  // A tie whose body moves or takes part or not from now on.
  void renewIdle(BodyIndex body, const BodySet& bodies) {
    for (Tie& tie : slots) {
      if (!tie.alive || (tie.bodyA != body && tie.bodyB != body)) continue;
      const bool idle = tie.gone() || tiesNothing(tie, bodies);
      changed = changed || idle != tie.idle;
      tie.idle = idle;
    }
  }
  // The tie stays in its slot, but its bodies may collide.
  void letCollide(Index index) {
    changed = true;
    unpart(index);
  }

  // The tie is no longer one of its body `from`, until it becomes one of another.
  void takeOff(Index index, BodyIndex from) {
    changed = true;
    Tie& tie = slots[index];
    if (!tie.collides()) unpart(index);
    (tie.bodyA == from ? tie.bodyA : tie.bodyB) = kNoIndex;
  }
  void putOn(Index index, BodyIndex to) {
    changed = true;
    Tie& tie = slots[index];
    (tie.bodyA == kNoIndex ? tie.bodyA : tie.bodyB) = to;
    tie.born = true;
    if (!tie.collides()) part(index);
  }

  std::vector<Tie> slots;  // by index
  bool changed = false;    // ties came or went since the islands were built
  bool touchingChanged = false;

 protected:
  template <class Archive, class Set, class One>
  static void archiveSlots(Archive& a, Set& set, std::size_t least, One&& one) {
    const std::uint64_t count = a.count(set.slots.size(), least);
    if constexpr (Archive::kReading) set.slots.resize(std::size_t(count));
    for (auto& tie : set.slots) {
      bool alive = tie.alive;  // may be a bit
      a.flag(alive);
      if constexpr (Archive::kReading) tie.alive = alive;
      a.value(tie.generation);
      if (tie.alive) one(a, tie);
    }
    a.list(set.awake_);
    a.list(set.asleep_);
    a.list(set.free_);
    a.value(set.nextOrder_);
    a.flag(set.changed);
  }
  // After a snapshot was read.
  void findApart() {
    for (auto* list : {&awake_, &asleep_}) list->reserve(slots.size());
    apart_.clear();
    for (Index i = 0; i < slots.size(); i++)
      if (slots[i].alive && !slots[i].collides()) apart_.push_back(i);
    std::sort(apart_.begin(), apart_.end(), [&](Index a, Index b) { return pairOf(a) < pairOf(b); });
  }
  // `name`: of the kind, for messages.
  void checkLists(Findings& f, const BodySet& bodies, const std::string& name) const {
    std::vector<bool> listed(slots.size(), false);
    for (const auto* list : {&awake_, &asleep_}) {
      f.expect(isAscending(*list), name + ": not sorted, or twice");
      for (Index i : *list) {
        const bool fine = has(i) && !listed[i];
        f.expect(fine, name + ": one that is listed is not there, or is listed twice");
        if (fine) listed[i] = true;
      }
    }
    for (Index i = 0; i < slots.size(); i++) {
      const Tie& tie = slots[i];
      f.expect(tie.alive == listed[i], name + ": one is neither awake nor asleep");
      if (!tie.alive) continue;
      const bool fine = bodies.alive(tie.bodyA) && bodies.alive(tie.bodyB) && tie.bodyA != tie.bodyB &&
                        !bodies.data[tie.bodyA].quarantined && !bodies.data[tie.bodyB].quarantined;
      f.expect(fine, name + ": one names bodies that are not there");
      if (!fine) continue;
      f.expect(tie.idle == (tiesNothing(tie, bodies) || tie.gone()),
               name + ": one is idle that ties something, or the reverse");
    }
    checkFreeSlots(f, free_, slots.size(), [&](std::size_t i) { return !slots[i].alive; });
  }
  void checkAsleep(Findings& f, const BodySet& bodies, const std::string& name) const {
    for (Index i : asleep_)
      for (BodyIndex body : {slots[i].bodyA, slots[i].bodyB})
        f.expect(slots[i].idle || (bodies.data[body].activity != BodyActivity::awake && !bodies.isDriven(body)),
                 name + ": one asleep names a body that is not");
    std::size_t apart = 0;
    for (const Tie& tie : slots) {
      if (!tie.alive || tie.collides()) continue;
      apart++;
      f.expect(!mayCollide(tie.bodyA, tie.bodyB), name + ": bodies that may not collide are not listed");
    }
    f.expect(apart == apart_.size(), name + ": bodies are listed as apart that nothing parts");
  }
  const std::vector<Index>& awake() const { return awake_; }

 private:
  // By little, not twofold: a world has many ties, which are made once.
  template <class T> static void grow(std::vector<T>& list) {
    if (list.size() == list.capacity()) list.reserve(list.size() + list.size() / 32 + 4);
  }
  static bool tiesNothing(const Tie& tie, const BodySet& bodies) {
    auto moves = [&](BodyIndex body) { return bodies.data[body].type == BodyType::dynamic; };
    if (!bodies.takesPart(tie.bodyA) || !bodies.takesPart(tie.bodyB)) return true;
    return !moves(tie.bodyA) && !moves(tie.bodyB);
  }
  using Pair = std::pair<BodyIndex, BodyIndex>;
  static Pair pairOf(BodyIndex a, BodyIndex b) { return {std::min(a, b), std::max(a, b)}; }
  Pair pairOf(Index tie) const { return pairOf(slots[tie].bodyA, slots[tie].bodyB); }
  typename std::vector<Index>::const_iterator placeOf(Pair pair) const {
    return std::lower_bound(apart_.begin(), apart_.end(), pair,
                            [&](Index tie, Pair than) { return pairOf(tie) < than; });
  }
  // Of those that keep the two apart.
  template <class Ask> bool everyTie(BodyIndex a, BodyIndex b, Ask&& ask) const {
    const Pair pair = pairOf(a, b);
    for (auto place = placeOf(pair); place != apart_.end() && pairOf(*place) == pair; ++place)
      if (!ask(slots[*place])) return false;
    return true;
  }
  void part(Index tie) {
    grow(apart_);
    apart_.insert(placeOf(pairOf(tie)), tie);
  }
  void unpart(Index tie) { apart_.erase(std::find(placeOf(pairOf(tie)), apart_.cend(), tie)); }
  template <class Visit> void eachLink(const std::vector<Index>& list, Visit& visit) const {
    for (Index tie : list)
      if (const Tie& t = slots[tie]; !t.idle) visit(Link{t.bodyA, t.bodyB, kLink, tie});
  }
  template <class Condition> void move(std::vector<Index>& from, std::vector<Index>& to, Condition leaves) {
    const std::size_t before = to.size();
    std::erase_if(from, [&](Index tie) {
      const bool goes = leaves(slots[tie].bodyA, slots[tie].bodyB);
      if (goes) to.push_back(tie);
      return goes;
    });
    if (to.size() > before) std::sort(to.begin(), to.end());
  }

  std::vector<Index> awake_, asleep_;  // ascending
  std::vector<Index> apart_;           // whose bodies may not collide: by these, the lower first
  std::vector<Index> free_;
  std::uint64_t nextOrder_ = 1;
};

}  // namespace brickfall
