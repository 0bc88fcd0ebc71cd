// The memory that the ties of an island keep of a step.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Writes the forces at the final motion into the memory of the island's ties. Returns true if any of them changed, or
// if the island does not rest. A force that would change by rounding only stays as it is, to the bit.
bool storeRows(Island& island, Ties& ties, StepContext& context);
// For an island's part of a step of `step` s: contacts tell of forces as their means over the step. The last part's
// force is the one that a point remembers. Of the parts before it nothing is remembered.
void tellMean(const Island& island, Ties& ties, double step);
// After all corrections of the motion: carries the ties on by it (gaps and drifts of contacts).
void advanceRows(Island& island, Ties& ties, const StepContext& context);

// Between storeRows and advanceRows: the work of all ties of an island, and what they hold after it.
TieWork workOf(const Island& island, const StepContext& context);
// Impulses of fixed and kinematic bodies on the island in the step, about the world's origin.
BalanceChange supportOf(const Island& island, const StepContext& context);

}  // namespace brickfall
