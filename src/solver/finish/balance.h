// Momentum and energy of an island at the end of a step, once, when nothing changes its motion any more.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Angular momentum: where ways and velocities of a floating island were changed apart (rebound, bodies stopped at obstacles,
// spins that the solve saw in part), that of its places and velocities has drifted; it becomes that of the start of the step
// and outside forces again. Energy: a converged implicit step never gains any; what one that ran out of cycles did gain
// is taken back. Both at the cost of what something presses on: what nothing touches flies on.
void balance(const Island& island, StepContext& context);

}  // namespace brickfall
