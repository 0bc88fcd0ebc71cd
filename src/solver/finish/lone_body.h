// One body that touches only fixed bodies, and slides, rolls, rocks or topples by itself.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Makes its motion of second order, while its contacts go on. Friction that stops the body within the step acts for a
// part of the step: the anchors of its points are to be where it stops.
void finishLoneBody(const Island& island, Ties& ties, StepContext& context);

}  // namespace brickfall
