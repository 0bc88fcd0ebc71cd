// Groups that slide on something fixed, to second order in the time step.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Bodies that press on each other and slide together on something flat and fixed (a stack, a row, a pushed wall): all are
// moved alike, so that as a whole they go by the mean of their old and new velocities. Only if no point that presses on
// the ground lands, leaves or sticks. How they move against each other is as it was solved.
void correctGroupSlides(Island& island, StepContext& context);

}  // namespace brickfall
