// Velocities at the end of a step, as joints let them be.
#pragma once
#include "solver/island.h"

namespace brickfall {

// The solve holds places: the way of a step leads along a chord from one place that joints allow to the next, and its
// velocity points off. Here impulses at the joints, where the step ends, take that part of the velocities. So errors of
// places, and their correction, give no velocity; momenta stay. Returns the energy taken, J.
double holdVelocities(Island& island, Ties& ties, StepContext& context);

// Nothing took energy from what swings in this step, unless something snapped; and what it keeps besides its energy, by
// how much that grew (J).
bool keepsEnergy(const Island& island);
double heldEnergy(const Island& island);

// What fixed and kinematic bodies gave by that.
BalanceChange supportAtEnd(const Island& island);

}  // namespace brickfall
