// The impacts of one moment: velocities change, no time passes. Each kind of tie has its own impact law
// (contact/impact.cpp).
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/island.h"

namespace brickfall {

// Whether an open point may close in a step of StepContext::dt. Asked without a solve, from the present speeds and
// fall, times `ahead`.
bool mayClose(const Island& island, const StepContext& context, double ahead);
// No tie carried force in the last step, and every point is open.
bool touchesNothing(const Island& island, const StepContext& context);
// In how many s the island's first open point closes; infinity if none does. Rows note which points close without an
// impact: too slowly for one. By StepContext::solved, the island's
// motion over `dt` s as if its open points were not there.
double firstClosing(Island& island, double dt, const StepContext& context);

// Changes the velocities of the island's bodies by the impacts at closed points, with friction and rebound. A point is
// closed if it is nearer than 20 micrometres, or than its approach takes it in `blink` s. Points that are hit are fresh
// afterwards. Returns false, and changes nothing, if its solve left more than a hundredth of the forces unbalanced, or
// if energy would rise by more than a hundredth of the change takes back: by less, all of the change is that much less.
bool solveImpact(Island& island, Ties& ties, BodySet& bodies, StepContext& context, double blink,
                 SolveStatistics& statistics, std::pmr::vector<TieImpact>& impacts);

}  // namespace brickfall
