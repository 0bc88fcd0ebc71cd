// Rebound of elastic impacts, after the primal solve has stopped them.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Contacts with restitution e > 0 that met faster than SolverSettings::restitutionSpeed and carried force get e x impact speed back, by
// normal impulses (the friction of the impact is the primal solve's). Changes StepContext::solved of the island's bodies;
// total energy never rises by it.
void rebound(Island& island, Ties ties, StepContext& context);

}  // namespace brickfall
