// From the solve to the motion of bodies, to second order where the forces on a group of them go on as they are. Groups
// are moved rigidly, so that no body in them moves against its neighbours. docs/step.md ("The finish") has the table of
// groups and what is done with each.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Linear and angular momentum of each group that flies become exact: a solve that acts on one body after the other
// leaves them off by its residual. The group is moved by the mean of its velocities under outside forces, unless
// anything is nearer than that. What presses on smooth flat ground alone keeps its linear momentum along that.
void finishFlights(const Island& island, StepContext& context);
// One body that touches only fixed bodies, and slides, rolls, rocks or topples by itself, while its contacts go on.
// Friction that stops it within the step acts for a part of the step: its points are anchored where it stops.
void finishLoneBody(const Island& island, Ties& ties, StepContext& context);
// A chunk that mortar joins to nothing fixed, and that rocks or topples: it is moved by the mean of its velocities, as
// one rigid body, if no point at which it presses on anything lands or leaves. Returns 1 for each body that was moved;
// nothing where there is no chunk.
std::pmr::vector<char> finishChunks(const Island& island, StepContext& context);
// Bodies that press on each other and slide together on something flat: a stack, a row, a pushed wall; one body only
// where the ground moves. Only if no point that presses on the ground lands, leaves or sticks, and the ground does not
// turn. A body that friction ties to the ground counts as ground, and so does one that was `moved` already. Motions of
// the bodies against each other stay as solved.
void finishSlides(Island& island, const std::pmr::vector<char>& moved, StepContext& context);

}  // namespace brickfall
