// How fast bodies turn, as their joints see it.
#pragma once
#include "solver/island.h"

namespace brickfall {

// rad/s: of the fastest body that a joint ties. Arms and axes of joints are frozen in a step, and a body that turns far
// in it nods and is torn out. A turn about a hinge moves no arm. It still turns aside what would tilt its axis, as a
// top does: so it counts by its inertia against that of both bodies, and not at all where the other one stays.
double jointedSpin(const Island& island, const StepContext& context);

// A hinge's turns lie across the axis of A, unless B spins about its own by more than the solve sees, and faster.
JointPose withSpins(JointPose pose, const Joint& joint, const BodySet& bodies, double dt);

}  // namespace brickfall
