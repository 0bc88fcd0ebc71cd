// The solve sees bodies with the arms and points of the start of a step, and contacts are found along the velocities
// before it. So what turns far, what a hit throws elsewhere and what goes on otherwise may end in something. Such
// bodies are fitted in where they end: overlap that no force made would be seen, and be let go by a tenth in each step.
#pragma once
#include "world/activity.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

// Moves and turns bodies that end elsewhere than their contacts foresaw, and those that they press on, until they are
// no deeper in what they meet than they began. Two that fly part along their relative velocity, which keeps momenta.

// All awake islands, and what they would end in without a contact. What is left is told in StepContext::overlap.
void keepOut(const Activity& activity, const Registry& registry, const Proximity& proximity, StepContext& context);
// One island, by its contacts; on a way to an impact, of which contacts foretell only its start, all of its bodies.
// Returns whether anything was moved.
bool keepOut(const Island& island, bool toImpact, const Registry& registry, StepContext& context);

}  // namespace brickfall
