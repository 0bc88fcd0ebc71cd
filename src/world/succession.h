// A body is replaced by several, and its contacts by theirs. The memory of its points goes on in the nearest points of
// the pieces, so that bodies that lean on them are carried from the first step as before. Without that memory a new
// point carries nothing yet, and all bodies above fall for a step.
#pragma once
#include <vector>

#include "dynamics/ties.h"
#include "world/proximity.h"

namespace brickfall {

class Succession {
 public:
  // Remembers all contacts of the body here: to be called before the body is taken out.
  Succession(const Registry& registry, const ContactSet& contacts, BodyIndex body);
  // Makes the contacts of the pieces with the body's neighbours, and hands the memory on.
  void pass(const Registry& registry, const std::vector<BodyIndex>& pieces, Proximity& proximity, Ties& ties) const;

 private:
  // A contact of the body, seen from it, in world axes.
  struct Estate {
    ShapeIndex neighbour = kNoIndex;
    Contact contact;
    double reach = 0;                // m, within which a point may take over the memory of another
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
  std::vector<CandidatePair> meet(const Registry& registry, const std::vector<BodyIndex>& pieces, Proximity& proximity,
                                  Ties& ties) const;
  std::vector<Bequest> bequests(const std::vector<Estate>& heirs) const;

  std::vector<Estate> estates_;
};

}  // namespace brickfall
