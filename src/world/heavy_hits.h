// In how many parts a step is made, so that nothing heavy goes right through what it hits within one of them.
#pragma once
#include "world/activity.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

// 1 .. `most`, for a step of `dt` s: as many as it takes for what is far heavier than something on its way to go half through
// that in each. Contacts are found where a part begins: what the struck bodies meet on their way out must begin another.
int partsForHits(const Registry& registry, const Activity& activity, const Proximity& proximity, double dt, int most);

}  // namespace brickfall
