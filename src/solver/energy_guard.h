// A converged implicit step never gains energy; one that ran out of cycles can.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Takes back from the velocities of an island what kinetic plus potential energy gained in the step beyond the work of
// outside forces. Linear and angular momentum of a floating island are kept: only motion relative to its rigid motion is
// scaled. Islands that something kinematic moves are left alone.
void guardEnergy(const Island& island, StepContext& context);

}  // namespace brickfall
