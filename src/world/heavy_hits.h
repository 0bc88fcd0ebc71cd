// How long the next part of a step is, so that nothing heavy goes right through a body that it hits within one part.
#pragma once
#include "dynamics/ties.h"
#include "world/activity.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

struct HitPart {
  double length = 0;    // s
  bool flight = false;  // nothing hits in it
  double rings = 0;     // s: waves of a blow on mortar are under way, and the next part is no longer; 0: none are
};

// What is left of a step.
struct HitRoom {
  double left = 0;     // s
  int most = 1;        // parts in which it is to be made at most, >= 1
  double resting = 0;  // m/s, at the scale of reference: slower, a body does not strike what mortar holds
  double gravity = 0;  // m/s2, by which scales are judged
};

// The next part of what is left of a step, after `before`. In a part a body far heavier than one on its way goes at
// most 0.35 of its thickness through it; where mortar holds that, any heavier one. A blow that breaks mortar begins
// with half of the time in which its whole strength gives the blow's impulse. Each part after it is at most a third
// longer than the one before, in this step and those that follow. Contacts are found where a part begins: bodies that a
// struck body meets on its way out must begin another. The flight before a hit is one part, and a trifle is left: the
// hit is not in it. The part after it goes a fourth as far, and grows, too: each is at most twice the one before and,
// where parts are too few, as long as all after it.
HitPart partForHits(const Registry& registry, const Activity& activity, const Proximity& proximity, const Ties& ties,
                    const HitRoom& room, const HitPart& before);

}  // namespace brickfall
