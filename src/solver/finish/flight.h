// Bodies that nothing supports fly the exact parabola.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Implicit Euler puts a flying body g dt^2 / 2 too low in every step. Groups that nothing supports, and that have nothing
// supported nearer than that, are moved back alike: their centre of mass flies the exact parabola. (Shifting bricks of a
// settling heap, which part for a step or two, against each other would pump energy into it.) Also sets
// SolvedMotion::flying.
void correctFlight(Island& island, StepContext& context);

}  // namespace brickfall
