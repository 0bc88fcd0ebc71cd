// Groups that nothing supports: momentum, and the parabola.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Linear and angular momentum of each group that flies become exact: a solve that acts on one body after the other
// leaves them off by its residual. The group is moved by the mean of its velocities under outside forces, unless
// anything is nearer than that.
void finishFlights(const Island& island, StepContext& context);

}  // namespace brickfall
