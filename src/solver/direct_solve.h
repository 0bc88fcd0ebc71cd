// Newton on all bodies of a small island at once, after the cycles.
#pragma once
#include "solver/island.h"

namespace brickfall {

// From the present motion, with its Island::residual, until the worst residual is under `tolerance` weights, or after
// many steps under ten times that.
void solveDirectly(Island& island, const StepContext& context, double tolerance, SolveStatistics& statistics);

}  // namespace brickfall
