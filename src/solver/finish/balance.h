// The last check of a step: no group of bodies has more energy than it had and was given.
#pragma once
#include "solver/island.h"

namespace brickfall {

// To be called when nothing changes the motion any more. A group may gain no more kinetic energy in the step than the
// work of gravity, of outside forces and of its ties. (Ties give energy stored in them, rebounds of impacts, and the
// work of kinematic bodies.) The excess is taken back from the velocities. Returns it, J, without the energy of the
// residual that the solve left.
double checkEnergy(const Island& island, StepContext& context);

}  // namespace brickfall
