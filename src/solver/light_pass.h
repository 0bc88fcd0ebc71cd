// The residuals of an island at the present motion.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Reads the forces at the present motion into Island::residual. With `renewBounds`, friction limits that follow the
// solve are renewed first: the residual that is judged is that of the valid friction limits.
void lightPass(Island& island, bool renewBounds, double& visits);
// Largest residual of a body over its weight or, if that is more, over a fiftieth of its load. A torque counts as a
// force at the body's inner radius. In floats a body that carries thousands of weights cannot be balanced to a
// thousandth of its own.
double worstResidual(const Island& island, const BodySet& bodies);
// Residuals that a solve left, by each body's load: the largest one over max(weight, load) (torque as above), and
// how many bodies have more than 5 %.
struct LeftOver {
  double worst = 0;
  int bodies = 0;
};
LeftOver leftOver(const Island& island, const BodySet& bodies);
// Root of the mean square of |force residual| / weight.
double rmsResidual(const Island& island, const BodySet& bodies);

}  // namespace brickfall
