// The last check of a step: no group of bodies has more energy than it had and was given.
#pragma once
#include "solver/island.h"

namespace brickfall {

// When nothing changes the motion any more: kinetic energy of each group at the end of the step is at most that of its start and the
// work of gravity, of outside forces and of its ties (what they held, rebounds of impacts, and what kinematic bodies did). What is
// over is taken back from the velocities. Returns it, J, beside what the solve had left out of balance.
double checkEnergy(const Island& island, StepContext& context);

}  // namespace brickfall
