// The solve of an island that is not at rest.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Relaxation by cycles, and the direct solve where the plan has it, until every body is in balance; then what impacts that are
// over give back. Leaves motion, residuals and loads, and the island's ending.
// Touches nothing but the island, so that islands may be solved side by side; counts into `statistics`.
void runCycles(Island& island, const StepContext& context, SolveStatistics& statistics);

// Its parts: what must be known first, with the motion to start from; then towards balance from the motion that is there,
// which returns true when every body is in balance.
void startCycles(Island& island, const StepContext& context);
bool goOn(Island& island, const StepContext& context, SolveStatistics& statistics);

}  // namespace brickfall
