// The solve of an island that is not at rest.
#pragma once
#include "solver/island.h"

namespace brickfall {

class Renewals;

// Relaxation by cycles, and the direct solve where the plan has it, until every body is in balance; then the rebounds
// of impacts that are over. Leaves motion, residuals and loads, and the island's ending. Touches nothing but the
// island, so that islands may be solved side by side; counts into `statistics`.
void runCycles(Island& island, const StepContext& context, SolveStatistics& statistics);

// The parts of runCycles. The first prepares the solve and sets the motion to start from. The second goes on towards
// balance from the present motion, and may set anew what is frozen in it. It returns true when every body is in
// balance.
void startCycles(Island& island, const StepContext& context);
bool goOn(Island& island, const StepContext& context, SolveStatistics& statistics, Renewals* renewals = nullptr);

// The cycles (relaxation.cpp). They start from the present motion. A cycle moves a level's clusters all at once, then
// one by one each body that is still out of balance. Bodies with a small residual are left alone and cost nothing.
// Returns true when every body is in balance, false when the cycles of the plan were used up. Where the plan says so,
// it sets anew what is frozen in the solve as it goes.
bool relax(Island& island, const StepContext& context, SolveStatistics& statistics, Renewals* renewals = nullptr);

// Newton on all bodies of a small island at once (direct_solve.cpp). From the present motion and Island::residual,
// until the worst residual is under `tolerance` weights, or after many steps under ten times that.
void solveDirectly(Island& island, const StepContext& context, double tolerance, SolveStatistics& statistics);

}  // namespace brickfall
