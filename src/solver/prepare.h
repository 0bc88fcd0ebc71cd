// From contacts and bodies to what the solve reads.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Body constants and free motions of the island.
void prepareBodies(Island& island, const StepContext& context);
// What the rows read in the solve, from what they remember and how their bodies lie.
void prepareRows(Island& island, Ties ties, const StepContext& context);

}  // namespace brickfall
