// The end of an island's solve: forces kept for the next step, motion handed to the bodies.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Reads the forces at the final motion into what the ties of the island remember. Returns true if any bit of it changed.
bool storeRows(Island& island, Ties ties, StepContext& context);
// Motion and velocities of the island's bodies into StepContext::solved.
void storeMotion(const Island& island, StepContext& context);
// Whether what was found is finite, of every body.
bool solvedWell(const Island& island, const StepContext& context);
// After all corrections of the motion: carries the ties on by it (gaps and drifts of contacts).
void advanceRows(Island& island, Ties ties, const StepContext& context);

// Bodies without contacts: free motion, moved by the mean of old and new velocity.
void storeFreeBody(BodyIndex body, StepContext& context);

// Implicit Euler puts a flying body g dt^2 / 2 too low in every step. Groups that are held by nothing, and have nothing
// held nearer than that, are moved back alike: their centre of mass flies the exact parabola. (Shifting bricks of a
// settling heap, which part for a step or two, against each other would pump energy into it.) Also sets
// SolvedMotion::flying.
void correctFlight(Island& island, StepContext& context);

// The same for one body alone on something fixed that slides, rolls, rocks or topples: it moves with the mean of its old and
// new velocities, so that ways and times are right to second order in dt. Only if all points that carry force are
// neither landing nor leaving.
void correctLoneBody(const Island& island, StepContext& context);

}  // namespace brickfall
