// Newton on all bodies of a small island at once, for what the cycles leave.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Islands that are solved directly if their first cycles do not balance them: small ones, and larger ones that are slow
// enough for a collapse to be at its start, or a wall to be settling.
bool solvesDirectly(const Island& island, const StepContext& context);

// From the present motion, of which Island::residual is known, until the worst residual is under `tolerance` weights.
void solveDirectly(Island& island, const StepContext& context, double tolerance, SolveStatistics& statistics);

}  // namespace brickfall
