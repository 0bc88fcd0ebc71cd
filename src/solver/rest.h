// How islands come to rest.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Stops a slow island whose kinetic energy has just passed a maximum (kinetic damping, as in dynamic relaxation). At
// that moment a vibration is at its balance, so one stop ends it. Otherwise a tall wall on elastic contacts sways by
// tenths of a millimetre for seconds. An island that topples or collapses gains energy from step to step and is never
// stopped, nor is a body that nothing presses on. To be called before the bodies' free motion is predicted.
void dampSlowIsland(Island& island, const StepContext& context, BodySet& bodies);

// Without any motion, do the forces of the last step still balance? Then an island in which all but nothing moves stays
// where it is, for the price of one light pass. Sets Island::ending; leaves all motion at zero.
void restCheck(Island& island, StepContext& context);

// The other way to rest: a slow island stays where it is if no point of it strays from its place for a while. The last
// of its residual may then be over the limit. (A thin wall goes on swaying by micrometres. A point at the very edge of
// sliding or opening changes sides in every step.) Called before storeMotion, which then leaves all bodies in place.
void restInPlace(Island& island, const StepContext& context);

}  // namespace brickfall
