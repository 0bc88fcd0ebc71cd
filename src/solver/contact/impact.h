// What a solve up to an impact and the solve of it agree on.
#pragma once
#include "solver/island.h"

namespace brickfall {

//! not of the method: a mark
constexpr float kNoForce = 1e30f;  // N: so far from closed is a point that does not exist

// m/s: slower impacts are left to the step.
double slowestImpact(const Island& island, const StepContext& context);

}  // namespace brickfall
