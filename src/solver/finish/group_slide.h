// Groups that slide on something fixed or kinematic, to second order in the time step.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Bodies that press on each other and slide together on something flat (a stack, a row, a pushed wall; one body only where
// the ground moves: finish/lone_body.h): all are moved alike, so that as a whole they go by the mean of their old and new
// velocities. Only if no point that presses on the ground lands, leaves or sticks, and the ground does not turn. What
// friction holds to the ground counts as ground. How they move against each other is as it was solved.
void finishSlides(Island& island, StepContext& context);

}  // namespace brickfall
