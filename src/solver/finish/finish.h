// From the solve to the motion of bodies. Implicit Euler moves every body by its velocity at the end of the step, which
// is right to first order in the step's length. Where the forces on a group of bodies go on as they are, the mean of
// its old and new velocities is right to second order. A group is moved rigidly, so that no body in it moves against
// its neighbours:
//
//   a group that | presses on                            | is moved by the mean of its velocities | its velocities
//   -------------+---------------------------------------+----------------------------------------+------------------
//   flies        | nothing                               | under outside forces (flight.h)        | keep both momenta
//   is alone     | fixed things, a body in an island     | in all of its motion (lone_body.h)     | are up to date
//                | of one                                |                                        |
//   swings       | anything, besides hanging on joints   | not, but as it slides                  | are up to date
//                |                                       |                                        | (joint/swings.h)
//   slides       | ground along which all its points do  | along the ground (group_slide.h)       | as solved
//   stands       | anything else                         | not                                    | as solved
#pragma once
#include "solver/island.h"

namespace brickfall {

// To be called after the forces of the step are stored. Sets the groups of the island, and StepContext::solved of its
// bodies.
void finishMotion(Island& island, Ties& ties, StepContext& context);

}  // namespace brickfall
