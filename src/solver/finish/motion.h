// What the solve found, as motion of the bodies.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Ways, turns and velocities of the island's bodies into StepContext::solved: none at all if it rests, those of free motion where
// nothing presses on a body.
void storeMotion(const Island& island, StepContext& context);

// Whether what was found is finite, of every body.
bool solvedWell(const Island& island, const StepContext& context);

// Bodies that nothing ties: free motion over `dt` s, moved by the mean of old and new velocity.
void storeFreeBody(BodyIndex body, double dt, StepContext& context);

}  // namespace brickfall
