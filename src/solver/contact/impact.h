// Shared by the solve up to an impact and the solve of the impact.
#pragma once
#include "solver/island.h"

namespace brickfall {

//! not of the method: a mark
constexpr float kNoForce = 1e30f;  // N: a point that does not exist is so far from closed

// m/s: slower impacts are left to the step.
double slowestImpact(const Island& island, const StepContext& context);

}  // namespace brickfall
