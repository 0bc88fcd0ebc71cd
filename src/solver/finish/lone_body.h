// One body that touches only what is fixed: what slides, rolls, rocks or topples by itself.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Of second order, while its contacts go on. Friction that stops the body within the step acts for a part of it: the anchors of its
// points are to be where it stops.
void finishLoneBody(const Island& island, Ties ties, StepContext& context);

}  // namespace brickfall
