// Shared by the solve up to an impact and the solve of the impact.
#pragma once
#include "solver/island.h"

namespace brickfall {

// m/s: slower impacts are left to the step.
double slowestImpact(const Island& island, const StepContext& context);

}  // namespace brickfall
