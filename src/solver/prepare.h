// From contacts and bodies to what the solve reads.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Body constants and free motions of the island.
void prepareBodies(Island& island, const StepContext& context);
// Records: frames and arms where something moved, gaps and anchors mapped, trial forces.
void prepareContacts(Island& island, StepContext& context);

}  // namespace brickfall
