// How islands come to rest; docs/step.md says why so.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Stops a slow island whose kinetic energy has just passed a maximum (kinetic damping, as in dynamic relaxation). To be
// called before the bodies' free motion is predicted.
void dampSlowIsland(Island& island, const StepContext& context, BodySet& bodies);

// Without any motion, do the forces of the last step still balance? Then an island in which all but nothing moves stays
// where it is, for the price of one light pass. Sets Island::ending; leaves all motion at zero.
void restCheck(Island& island, StepContext& context);

// The other way to rest: a slow island stays where it is if no point of it strays from its place for a while, whatever
// residual is left. Called before storeMotion, which then leaves all bodies in place.
void restInPlace(Island& island, const StepContext& context);

}  // namespace brickfall
