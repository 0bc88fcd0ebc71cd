// Candidate pairs of shapes and the contacts made of those that are near.
// Pairs lie sorted by (shapeA, shapeB): every loop over contacts runs in that order, whatever the broad phase's history.
#pragma once
#include <vector>

#include "dynamics/contact.h"

namespace brickfall {

struct CandidatePair {
  ShapeIndex shapeA = 0, shapeB = 0;  // shapeA < shapeB
  BodyIndex bodyA = 0, bodyB = 0;
  ContactIndex contact = kNoIndex;  // kNoIndex: no points at present
};
inline bool operator<(const CandidatePair& a, const CandidatePair& b) {
  return a.shapeA != b.shapeA ? a.shapeA < b.shapeA : a.shapeB < b.shapeB;
}

class ContactSet {
 public:
  ContactIndex create();
  void destroy(ContactIndex contact);
  const std::vector<ContactIndex>& unused() const { return free_; }
  // Takes in pairs, sorted; those that are known stay as they are.
  void insert(const std::vector<CandidatePair>& found);

  std::vector<CandidatePair> pairs;   // of which at least one body is awake, sorted
  std::vector<CandidatePair> asleep;  // both asleep or fixed, sorted
  std::vector<Contact> contacts;      // by ContactIndex
  std::vector<ContactGeometry> geometry;
  bool changed = true;          // contacts appeared or went since the islands were built
  bool touchingChanged = true;  // which contacts press changed since the events were collected

 private:
  friend class SnapshotArchive;
  std::vector<ContactIndex> free_;
};

}  // namespace brickfall
