// The program's callback before the solve: who may touch, and how rough, for one part of a step.
#pragma once
#include "brickfall/world.h"

namespace brickfall {

class Registry;
class Ties;
class Upkeep;

// After all contacts of the part are found. Contacts that are switched off end.
void askPreSolve(const World::PreSolve& callback, Registry& registry, Ties& ties, Upkeep upkeep);

}  // namespace brickfall
