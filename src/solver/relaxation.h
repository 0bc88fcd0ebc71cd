// The cycles of a solve: bodies out of balance are moved, bodies in balance are left alone.
#pragma once
#include "solver/island.h"

namespace brickfall {

class Renewals;

// Starts from the present motion. A cycle moves the clusters of one level, all at once, then one by one each body that
// is still out of balance. Bodies with a small residual are left alone and cost nothing. Returns true when every body
// is in balance, false when the cycles of the plan were used up. Leaves motion, residuals and loads.
// Where the plan says so, it sets anew what is frozen in the solve as it goes.
bool relax(Island& island, const StepContext& context, SolveStatistics& statistics, Renewals* renewals = nullptr);

}  // namespace brickfall
