// Newton on all bodies of a small island at once, for what the cycles leave.
#pragma once
#include "solver/island.h"

namespace brickfall {

// From the present motion, of which Island::residual is known, until the worst residual is under `tolerance` weights, or after
// many steps under ten times that.
void solveDirectly(Island& island, const StepContext& context, double tolerance, SolveStatistics& statistics);

}  // namespace brickfall
