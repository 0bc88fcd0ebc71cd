// Which impacts rebound.
#pragma once
#include "solver/island.h"

namespace brickfall {

// m/s: slower impacts do not rebound. In a heap every body would chatter with its neighbours. A body alone on something
// fixed bounces on until a bounce takes no more than two steps.
double slowestRebound(const Island& island, const StepContext& context);

}  // namespace brickfall
