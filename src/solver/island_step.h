// The step of an island, phase by phase: the one place that says what is done, and in which order. The stages of a world take all islands
// through a phase before the next, so that each phase has its time, its hash and its line in the ledger. Parts that impacts cut off a step
// (stage_impacts.cpp) go through all of them at once, and so do tests.
//
// Which part of its step an island makes, and how long it is, Island::part and Island::dt say. A settled island is passed over.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Facts and plan; kinetic damping; where each body would go if nothing touched it; from ties to the rows of the solve.
void prepareIsland(Island& island, Ties ties, BodySet& bodies, StepContext& context);

// Whether last step's forces balance without motion: Island::ending.
void restIsland(Island& island, StepContext& context);

// Displacements and turns, unless the island rests. Touches nothing but the island, so that islands are solved side by side.
void solveIsland(Island& island, const StepContext& context, SolveStatistics& statistics);

// Forces go to the ties, motions to StepContext::solved, those of free flight and of bodies alone to second order.
void storeIsland(Island& island, Ties ties, StepContext& context);

// Momentum and energy, once, when nothing changes the motion any more.
void balanceIsland(const Island& island, StepContext& context);

// All phases, one after the other, for a part of `dt` s. Moves nothing: StepContext::solved says where the part leads.
void stepIsland(Island& island, IslandPart part, double dt, Ties ties, BodySet& bodies, StepContext& context,
                SolveStatistics& statistics);

}  // namespace brickfall
