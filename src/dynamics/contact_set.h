// Candidate pairs of shapes and the contacts made of those that are near.
// Pairs lie sorted by (shapeA, shapeB, part): every loop over contacts runs in that order, whatever the broad phase's history.
#pragma once
#include <cstddef>
#include <vector>

#include "dynamics/contact.h"
#include "dynamics/link.h"

namespace brickfall {

struct CandidatePair {
  ShapeIndex shapeA = 0, shapeB = 0;  // shapeA < shapeB
  BodyIndex bodyA = 0, bodyB = 0;
  ContactIndex contact = kNoIndex;  // kNoIndex: no points at present
  // A shape may lean on a mesh in several directions at once: a contact for each. Entries beyond 0 are there only with one.
  std::uint32_t part = 0;
};
inline bool operator<(const CandidatePair& a, const CandidatePair& b) {
  if (a.shapeA != b.shapeA) return a.shapeA < b.shapeA;
  return a.shapeB != b.shapeB ? a.shapeB < b.shapeB : a.part < b.part;
}

class ContactSet {
 public:
  ContactIndex create();
  void destroy(ContactIndex contact);
  // An impact of this step.
  void strike(ContactIndex contact);
  const std::vector<ContactIndex>& unused() const { return free_; }
  // Takes in pairs, sorted; those that are known stay as they are.
  void insert(const std::vector<CandidatePair>& found);
  void dropBetween(BodyIndex a, BodyIndex b);  // they may no longer collide

  // --- functions of every kind of tie (ties.h asks them). Pairs without points sleep and go as those with a contact do.
  static constexpr LinkKind kLink = LinkKind::contact;
  // visit(link), in the order of the set: ties of which at least one body is awake, or moves; and those of which none
  // is.
  template <class Visit> void eachAwake(Visit&& visit) const { eachLink(pairs, visit); }
  template <class Visit> void eachAsleep(Visit&& visit) const { eachLink(asleep, visit); }
  bool anyAsleep() const { return !asleep.empty(); }  // be it a tie yet or not
  // Ties whose bodies fulfil leaves(a, b), or wakes(a, b).
  template <class Leaves> void sleepWhere(Leaves leaves) { movePairs(pairs, asleep, leaves); }
  template <class Wakes> void wakeWhere(Wakes wakes) { movePairs(asleep, pairs, wakes); }
  void dropOf(BodyIndex body);  // the body goes
  // The body is put elsewhere, or its type or centre of mass changes. Its pairs are found anew.
  void displace(BodyIndex body) { dropOf(body); }
  bool mayCollide(BodyIndex, BodyIndex) const { return true; }  // the set lets shapes of these two touch
  // The body's material has changed, and with it perhaps its mass.
  void renewConstants(BodyIndex body, const ShapeSet& shapes, const BodySet& bodies);
  void beginStep();                               // or a part of one: no contact is struck
  void keepRoom(std::size_t shapes);              // of a world of so many: the step itself takes no memory
  void hash(Mix& h, ContactIndex contact) const;  // all that it remembers
  void archive(WriteArchive& a) const;
  void archive(ReadArchive& a);
  // What must hold before a tie may be followed; values that a snapshot may have; all the rest.
  void checkStructure(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;
  void checkRanges(Findings& f) const;
  void check(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;

  std::vector<CandidatePair> pairs;   // of which at least one body is awake, sorted
  std::vector<CandidatePair> asleep;  // both asleep or fixed, sorted
  std::vector<Contact> contacts;      // by ContactIndex
  std::vector<ContactGeometry> geometry;
  std::vector<ContactIndex> struck;  // those with Contact::struck
  bool changed = true;               // contacts appeared or went since the islands were built
  bool touchingChanged = true;       // which contacts press changed since the events were collected

 private:
  template <class Archive, class Set> static void archiveAll(Archive& a, Set& set);
  template <class Visit> static void eachLink(const std::vector<CandidatePair>& list, Visit& visit) {
    for (const CandidatePair& pair : list)
      if (pair.contact != kNoIndex) visit(Link{pair.bodyA, pair.bodyB, kLink, pair.contact});
  }
  template <class Condition>
  void movePairs(std::vector<CandidatePair>& from, std::vector<CandidatePair>& to, Condition leaves) {
    moved_.clear();
    std::size_t kept = 0;
    for (const CandidatePair& pair : from) {
      if (leaves(pair.bodyA, pair.bodyB))
        moved_.push_back(pair);
      else
        from[kept++] = pair;
    }
    from.resize(kept);
    mergeInto(to, moved_);
  }
  template <class Names> void dropWhere(Names names) {
    for (auto* list : {&pairs, &asleep})
      std::erase_if(*list, [&](const CandidatePair& pair) {
        if (!names(pair)) return false;
        if (pair.contact != kNoIndex) destroy(pair.contact);
        return true;
      });
  }
  static void mergeInto(std::vector<CandidatePair>& sorted, const std::vector<CandidatePair>& more);

  std::vector<ContactIndex> free_;
  std::vector<CandidatePair> moved_;  // scratch
};

double effectiveMass(const BodyMass& a, const BodyMass& b);  // kg, of two bodies that press on each other
double crushingOf(const ShapeDef& a, const ShapeDef& b);
// Constants that a contact takes from its shapes and bodies: friction, restitution, crushing, effective mass.
void takeConstants(Contact& c, const ShapeSet& shapes, const BodySet& bodies);
// What a contact remembers, without its geometry.
void mix(Mix& h, const Contact& c);

}  // namespace brickfall
