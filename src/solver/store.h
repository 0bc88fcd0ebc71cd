// The end of an island's solve: forces kept for the next step, motion handed to the bodies.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Reads the forces at the final motion into the contacts: multipliers, stick state, slip, weak flags. Returns true if any
// bit of them changed.
bool storeForces(Island& island, StepContext& context);
// Motion and velocities of the island's bodies into StepContext::solved.
void storeMotion(const Island& island, StepContext& context);
// After all corrections of the motion: carries gaps and drifts on by the displacement of each point.
void advanceGaps(Island& island, StepContext& context);

// Bodies without contacts: free motion.
void storeFreeBody(BodyIndex body, StepContext& context);

// Implicit Euler puts a flying body g dt^2 / 2 too low in every step. Groups that are held by nothing, and have nothing
// held nearer than that, are moved back alike: their centre of mass flies the exact parabola. (Shifting bricks of a
// settling heap, which part for a step or two, against each other would pump energy into it.) Also sets
// SolvedMotion::flying.
void correctFlight(Island& island, StepContext& context);

}  // namespace brickfall
