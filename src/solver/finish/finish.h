// From the solve to the motion of bodies, to second order where the forces on a group of them go on as they are. Groups
// are moved rigidly, so that no body in them moves against its neighbours. docs/step.md ("The finish") has the table of
// groups and what is done with each.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Groups that fly, lie on smooth ground, rock as chunks, or slide.
void finishGroups(const Island& island, StepContext& context);
// One body that touches only fixed bodies, and slides, rolls, rocks or topples by itself, while its contacts go on.
// Friction that stops it within the step acts for a part of the step: its points are anchored where it stops.
void finishLoneBody(const Island& island, Ties& ties, StepContext& context);

}  // namespace brickfall
