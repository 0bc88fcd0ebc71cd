// A body is replaced by several, and its contacts by theirs: what its points remembered goes on in the nearest points of the
// pieces, so that what leans on them is held from the first step as it was before. Without it a new point carries nothing
// yet, and all that is above falls for a step.
#pragma once
#include <vector>

#include "world/proximity.h"

namespace brickfall {

class Succession {
 public:
  // Of what is here a contact of the body: to be called before it goes.
  Succession(const Registry& registry, const ContactSet& contacts, BodyIndex body);
  // Makes the contacts of the pieces with those that the body had contacts with, and hands on what is remembered.
  void pass(const Registry& registry, const std::vector<BodyIndex>& pieces, Proximity& proximity) const;

 private:
  // A contact of the body, seen from it, in world axes.
  struct Estate {
    ShapeIndex neighbour = kNoIndex;
    Contact contact;
    double reach = 0;                // m, in which a point may go on with the memory of another
    Vec3 normal;                     // towards the body
    Vec3 tangent1, tangent2;         // along which the points' forces push the body
    Vec3 onBody[4], onNeighbour[4];  // m, anchors
  };
  // Point `from` of an estate goes on as point `to` of a pair's contact.
  struct Bequest {
    double apart;  // m2
    std::size_t heir, estate;
    int to, from;
  };

  static Estate seenFrom(const Registry& registry, const Contact& c, const ContactGeometry& g, bool bodyIsB);
  std::vector<CandidatePair> meet(const Registry& registry, const std::vector<BodyIndex>& pieces,
                                  Proximity& proximity) const;
  std::vector<Bequest> bequests(const std::vector<Estate>& heirs) const;

  std::vector<Estate> estates_;
};

}  // namespace brickfall
