// One body on something fixed, to second order in the time step.
#pragma once
#include "solver/island.h"

namespace brickfall {

// One body alone on something fixed that slides, rolls, rocks or topples: it moves with the mean of its old and
// new velocities, so that ways and times are right to second order in dt. Only if all points that carry force are
// neither landing nor leaving.
void correctLoneBody(Island& island, Ties ties, StepContext& context);

}  // namespace brickfall
