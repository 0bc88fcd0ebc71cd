// The step of an island, stage by stage: the one place that says which work is done with an island, and in which order.
// A world takes all its islands through a stage before the next (world/stage_prepare.cpp and others), so that each
// stage has its time, its hash and its line in the ledger. Parts that impacts cut off a step (world/stage_impacts.cpp)
// go through all stages at once, and so do tests.
//
// Island::part and Island::dt say which part of its step an island makes, and how long the part is. A settled island is
// passed over.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Facts and plan; kinetic damping; where each body would go if nothing touched it; from ties to the rows of the solve.
void prepareIsland(Island& island, Ties& ties, BodySet& bodies, StepContext& context);

// Whether last step's forces balance without motion: Island::ending.
void restIsland(Island& island, StepContext& context);

// Displacements and turns, unless the island rests. Touches nothing but the island, so that islands are solved side by
// side.
void solveIsland(Island& island, const StepContext& context, SolveStatistics& statistics);

// Forces go to the ties, motions to StepContext::solved, those of free flight and of bodies alone to second order.
void storeIsland(Island& island, Ties& ties, StepContext& context);

// The last check, once, after every other change of the motion. Returns the energy that it took, J.
double balanceIsland(Island& island, Ties& ties, StepContext& context);

// All stages, one after the other, for a part of `dt` s. Moves no body: StepContext::solved says where the part leads.
void stepIsland(Island& island, IslandPart part, double dt, Ties& ties, BodySet& bodies, StepContext& context,
                SolveStatistics& statistics);

}  // namespace brickfall
