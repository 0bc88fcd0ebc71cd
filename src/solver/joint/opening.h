// Whether a part of a step, as it would end, opens a joint. What can't be solved in one part may be in shorter ones.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Not of what flies, where every part rounds up energy.
bool opensJoints(const Island& island, const StepContext& context);

}  // namespace brickfall
