// What the ties of an island remember of a step.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Reads the forces at the final motion into what the ties of the island remember. Returns true if any of them changed,
// or if the island does not rest; what would change by rounding only stays as it is, to the bit.
bool storeRows(Island& island, Ties ties, StepContext& context);
// Of an island's part of a step of `step` s: contacts tell of forces as their means over the step. The force that a point
// remembers counts for the last part; of those before it nothing is remembered.
void tellMean(const Island& island, Ties ties, double step);
// After all corrections of the motion: carries the ties on by it (gaps and drifts of contacts).
void advanceRows(Island& island, Ties ties, const StepContext& context);

}  // namespace brickfall
