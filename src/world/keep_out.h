// The solve sees bodies with the arms and points of the start of a step. Those that turn far end along an arc, and with
// other corners foremost. Where that leaves them in something, they are shifted out of it: overlap that no force made
// would otherwise be let go by a tenth in each step.
#pragma once
#include "solver/island.h"
#include "world/registry.h"

namespace brickfall {

// Parts bodies that turned far from those that they touch, so that they end no deeper in them than they began. Groups
// that fly keep their ways: only what something fixed supports, or a body alone, is shifted. Returns whether any was.
bool keepOut(const Island& island, const Registry& registry, StepContext& context);

}  // namespace brickfall
