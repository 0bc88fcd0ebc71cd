// Candidate pairs of shapes and the contacts made of those that are near.
// Pairs lie sorted by (shapeA, shapeB, part): every loop over contacts runs in that order, whatever the broad phase's history.
#pragma once
#include <cstddef>
#include <vector>

#include "dynamics/contact.h"

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
  // An impact of this step; and the next one begins.
  void strike(ContactIndex contact);
  void endStrikes();
  const std::vector<ContactIndex>& unused() const { return free_; }
  // Takes in pairs, sorted; those that are known stay as they are.
  void insert(const std::vector<CandidatePair>& found);
  // Moves the pairs that fulfil `leaves` from `pairs` to `asleep`, or back.
  template <class Condition> void moveToSleep(Condition leaves) { movePairs(pairs, asleep, leaves); }
  template <class Condition> void moveFromSleep(Condition leaves) { movePairs(asleep, pairs, leaves); }
  // Makes room ahead of a step, so that the step itself takes no memory.
  void keepRoom(std::size_t shapes);

  std::vector<CandidatePair> pairs;   // of which at least one body is awake, sorted
  std::vector<CandidatePair> asleep;  // both asleep or fixed, sorted
  std::vector<Contact> contacts;      // by ContactIndex
  std::vector<ContactGeometry> geometry;
  std::vector<ContactIndex> struck;  // those with Contact::struck
  bool changed = true;               // contacts appeared or went since the islands were built
  bool touchingChanged = true;       // which contacts press changed since the events were collected

 private:
  friend class SnapshotArchive;

  template <class Condition>
  void movePairs(std::vector<CandidatePair>& from, std::vector<CandidatePair>& to, Condition leaves) {
    moved_.clear();
    std::size_t kept = 0;
    for (const CandidatePair& pair : from) {
      if (leaves(pair))
        moved_.push_back(pair);
      else
        from[kept++] = pair;
    }
    from.resize(kept);
    mergeInto(to, moved_);
  }
  static void mergeInto(std::vector<CandidatePair>& sorted, const std::vector<CandidatePair>& more);

  std::vector<ContactIndex> free_;
  std::vector<CandidatePair> moved_;  // scratch
};

}  // namespace brickfall
