// What the solve found, as motion of the bodies: the one writer of StepContext::solved.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Ways, turns and velocities of the island's bodies as they were solved: none at all if it rests, those of free motion where no tie
// carries force at a body. Needs the island's groups.
void storeMotion(const Island& island, StepContext& context);
// Bodies that nothing ties: free motion over `dt` s, moved by the mean of old and new velocity.
void storeFreeBody(BodyIndex body, double dt, StepContext& context);

// Whether what was found is finite, of every body.
bool solvedWell(const Island& island, const StepContext& context);

// How velocities of a body change; not at all of what is fixed.
struct VelocityChange {
  Vec3 move, turn;  // m/s of the centre of mass; rad/s
};
// In this step, so far.
VelocityChange changeOf(BodyIndex body, const StepContext& context);

// Moves the body's end of the step by so much; a body that turns freely keeps its turn.
void shift(BodyIndex body, Vec3 way, Vec3 turn, StepContext& context);
// Adds to its velocities.
void accelerate(BodyIndex body, Vec3 velocity, Vec3 angularMomentum, StepContext& context);
// Leaves it a share of its way, and then `carried` (m), and a share of its turn. It keeps its velocities, but where it `falls`: gravity
// and other outside forces act for as long as it moves.
void shorten(BodyIndex body, double share, double turnShare, Vec3 carried, bool falls, StepContext& context);
// Its part of what impacts that go on have taken so far, J.
void keepLoss(BodyIndex body, double loss, StepContext& context);
// The body's contacts went on through the step: it remembers how its velocities changed (per second).
void rememberSteady(BodyIndex body, const SteadyChange& change, StepContext& context);

}  // namespace brickfall
