// The multilevel solve of an island that is not at rest.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Cycles over both hierarchies in turn, coarsest level first, from free motion until the residual is small: rms for a
// moving island, the worst body for a slow one (a looser stop can repeat the same not quite balanced state for ever).
// Leaves Island::motion.
// Touches nothing but the island, so that islands may be solved side by side; counts into `statistics`.
void runCycles(Island& island, const StepContext& context, SolveStatistics& statistics);

// A cluster sweep applies action and reaction at different moments, so the momentum of a floating island drifts by the
// residual left. One rigid step of the whole island, in double, makes linear and angular momentum exact.
void correctMomentum(Island& island, const StepContext& context);

}  // namespace brickfall
