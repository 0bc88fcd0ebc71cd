// From the solve to the motion of bodies. Implicit Euler moves everything by its velocity at the end of the step, which is right to
// first order in its length. Where the forces on a group of bodies go on as they are, the mean of its old and new velocities is right
// to second order; a group is moved rigidly, so that nothing in it moves against its neighbours:
//
//   a group that   | presses on          | is moved by the mean of its velocities            | its velocities
//   ---------------+---------------------+---------------------------------------------------+--------------------------------
//   flies          | nothing             | under gravity and outside forces (flight.cpp)     | keep linear and angular momentum
//   is alone       | fixed things, body  | in all of its motion (lone_body.cpp)              | follow the mean of both forces
//                  | of an island of one |                                                   |
//   slides         | ground along which  | along the ground (group_slide.cpp)                | as solved
//                  | all its points slide|                                                   |
//   stands         | anything else       | not                                               | as solved
#pragma once
#include "solver/island.h"

namespace brickfall {

// After the forces of the step are stored: groups of the island, and StepContext::solved of its bodies.
void finishMotion(Island& island, Ties ties, StepContext& context);

}  // namespace brickfall
