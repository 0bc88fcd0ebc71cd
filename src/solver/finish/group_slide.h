// Groups that slide on something fixed or kinematic, to second order in the time step.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Bodies that press on each other and slide together on something flat: a stack, a row, a pushed wall; one body only
// where the ground moves (finish/lone_body.h). All are moved alike, so that as a whole they go by the mean of their old
// and new velocities. Only if no point that presses on the ground lands, leaves or sticks, and the ground does not
// turn. A body that friction ties to the ground counts as ground. Motions of the bodies against each other stay as
// solved.
void finishSlides(Island& island, StepContext& context);

}  // namespace brickfall
