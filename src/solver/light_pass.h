// What is out of balance at the present motion.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Forces at the present motion into Island::residual. With `renewBounds`, bounds that follow the solve are renewed first:
// the residual that is judged is that of the bounds that hold.
void lightPass(Island& island, bool renewBounds, double& visits);
// Largest residual of a body, over its weight or, if that is more, a fiftieth of its load (torque: as a force at the body's
// inner radius): what carries thousands of weights cannot be balanced to a thousandth of its own in floats.
double worstResidual(const Island& island, const BodySet& bodies);
// What a solve left, by what each body carries: the largest residual over max(weight, load) (torque as above), and how many
// bodies are left over 5 %.
struct LeftOver {
  double worst = 0;
  int bodies = 0;
};
LeftOver leftOver(const Island& island, const BodySet& bodies);
// Root of the mean square of |force residual| / weight.
double rmsResidual(const Island& island, const BodySet& bodies);

}  // namespace brickfall
