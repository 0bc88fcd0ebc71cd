// The cycles of a solve: what is out of balance is moved, what is in balance is left alone.
#pragma once
#include "solver/island.h"

namespace brickfall {

// From the motion that is there. A cycle moves the clusters of one level, all at once, then one by one each body that
// is still out of balance. What has a small residual is left alone and costs nothing. Returns true when every body is
// in balance, false when the cycles of the plan were used up. Leaves motion, residuals and loads.
bool relax(Island& island, const StepContext& context, SolveStatistics& statistics);

}  // namespace brickfall
