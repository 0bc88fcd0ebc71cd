// In how many parts a step is made, so that nothing heavy goes right through a body that it hits within one part.
#pragma once
#include "dynamics/ties.h"
#include "world/activity.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

struct HitParts {
  int count = 1;
  bool ofHeld = false;  // what mortar holds asks for them, which slows down what hits it: one is made, then they are
                        // counted anew
  double flight = 0;    // share of the step that is made first, before anything hits
};

// The number of parts, 1 .. `most`, for a step of `dt` s. In each part a body far heavier than one on its way goes at
// most half through it. (Of what mortar holds: twice as heavy, a fourth. Before a blow that breaks it, no part is
// longer than a fourth of the time in which its whole strength stops the blow.) Contacts are found where a part begins:
// bodies that a struck body meets on its way out must begin another. Where `most` are too few for what mortar holds,
// the count is larger, and parts grow: each is as long as all after it at most. What flies towards it, or ends so near
// before it that it would fly ahead to it, gets one part for all of its flight.
HitParts partsForHits(const Registry& registry, const Activity& activity, const Proximity& proximity, const Ties& ties,
                      double dt, int most);

}  // namespace brickfall
