// The result of the solve, as motion of the bodies: the one writer of StepContext::solved.
#pragma once
#include <span>

#include "solver/island.h"

namespace brickfall {

// Sets ways, turns and velocities of the island's bodies as they were solved. An island that rests gets none. A body at
// which no tie carries force gets those of free motion. Needs the island's groups.
void storeMotion(const Island& island, StepContext& context);
// A solve with frozen arms does not say where a body points that turns by half a turn and more, or, in flight, by more
// than kLargestTurn: its momentum does, as in free flight. Else its energy would be another one for each way that it
// could point.
void turnFarFreely(const Island& island, StepContext& context);
// Bodies without ties: free motion over `dt` s, moved by the mean of old and new velocity.
void storeFreeBody(BodyIndex body, double dt, StepContext& context);

// Moves a body without joints and locks as if its ties were not there, for what is left of its step.
void goFreely(BodyIndex body, StepContext& context);
// The same for bodies that mortar joins: they go as one, or the arcs of their turns would part them. None has flown
// ahead.
void goAsOne(std::span<const std::uint32_t> group, const Island& island, StepContext& context);

// Whether the solved motion is finite, of every body.
bool solvedWell(const Island& island, const StepContext& context);

// How the body's velocities change in this step, so far.
VelocityChange changeOf(BodyIndex body, const StepContext& context);
// Those of a row's two bodies; none of partners.
EndChanges changesOf(RowEnds ends, const Island& island, const StepContext& context);

// By how much velocities at the start of the step, and at its end, are ahead of those of the solve: of what swings on
// joints. What flies has kept its momenta.
struct Lead {
  VelocityChange before, after;
};
Lead leadOf(BodyIndex body, const StepContext& context);

// Where the body points at the end of the step.
Quat rotationAtEnd(BodyIndex body, const StepContext& context);
// rad/s, at the end of the step: the momentum stays, the body turns under it, and its inertia with it.
Vec3 spinAtEnd(BodyIndex body, Vec3 angularMomentum, const StepContext& context);
// J, at the end of the step, seen from a frame that moves at `frame` (m/s).
double kineticEnergyAtEnd(BodyIndex body, Vec3 frame, const StepContext& context);

// Moves the body's place at the end of the step by so much; a body that turns freely keeps its turn.
void shift(BodyIndex body, Vec3 way, Vec3 turn, StepContext& context);
// Takes back the share of the step that the body has flown ahead; its velocities stay.
void takeBackAhead(BodyIndex body, StepContext& context);
// Adds to the body's velocities.
void accelerate(BodyIndex body, Vec3 velocity, Vec3 angularMomentum, StepContext& context);
// Leaves the body a share of its way, then `carried` (m), and a share of its turn. The body keeps its velocities,
// unless it `falls`: gravity and other outside forces act for as long as it moves.
void shorten(BodyIndex body, double share, double turnShare, Vec3 carried, bool falls, StepContext& context);
// The body's part of the energy that impacts which go on have taken so far, J.
void keepLoss(BodyIndex body, double loss, StepContext& context);
// The body's contacts went on through the step: it remembers how its velocities changed (per second).
void rememberSteady(BodyIndex body, const SteadyChange& change, StepContext& context);

}  // namespace brickfall
