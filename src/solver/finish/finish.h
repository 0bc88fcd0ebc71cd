// From the solve to the motion of bodies. Implicit Euler moves every body by its velocity at the end of the step, which
// is right to first order in the step's length. Where the forces on a group of bodies go on as they are, the mean of
// its old and new velocities is right to second order. A group is moved rigidly, so that no body in it moves against
// its neighbours:
//
//   a group that | presses on                            | is moved by the mean of its velocities | its velocities
//   -------------+---------------------------------------+----------------------------------------+------------------
//   flies        | nothing                               | under outside forces (flight.cpp)      | keep both momenta
//   is alone     | fixed things, a body in an island     | in all of its motion (lone_body.cpp)   | are up to date
//                | of one                                |                                        |
//   swings       | anything, besides hanging on joints   | not, but as it slides                  | are up to date
//                |                                       |                                        | (joint/swings.h)
//   slides       | ground along which all its points do  | along the ground (group_slide.cpp)     | as solved
//   stands       | anything else                         | not                                    | as solved
#pragma once
#include "solver/island.h"

namespace brickfall {

// The three corrections, each in the file of its name.
//
// Linear and angular momentum of each group that flies become exact: a solve that acts on one body after the other
// leaves them off by its residual. The group is moved by the mean of its velocities under outside forces, unless
// anything is nearer than that.
void finishFlights(const Island& island, StepContext& context);
// One body that touches only fixed bodies, and slides, rolls, rocks or topples by itself, while its contacts go on.
// Friction that stops it within the step acts for a part of the step: its points are anchored where it stops.
void finishLoneBody(const Island& island, Ties& ties, StepContext& context);
// Bodies that press on each other and slide together on something flat: a stack, a row, a pushed wall; one body only
// where the ground moves. Only if no point that presses on the ground lands, leaves or sticks, and the ground does not
// turn. A body that friction ties to the ground counts as ground. Motions of the bodies against each other stay as
// solved.
void finishSlides(Island& island, StepContext& context);

// To be called after the forces of the step are stored. Sets the groups of the island, and StepContext::solved of its
// bodies.
void finishMotion(Island& island, Ties& ties, StepContext& context);

}  // namespace brickfall
