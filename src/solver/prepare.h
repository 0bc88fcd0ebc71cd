// From contacts and bodies to the input of the solve.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Sets body constants and free motions of the island.
void prepareBodies(Island& island, const StepContext& context);
// Sets the rows that the solve reads, from the memory of their ties and the poses of their bodies.
void prepareRows(Island& island, Ties& ties, const StepContext& context);

}  // namespace brickfall
