// Bodies that nothing but joints holds, at the end of a step.
//
// Their steps are those of a leapfrog: the solve finds the velocity of the middle of a step, and the place of its end.
// So that both are of one moment, forces give half of their impulses more where the step ends, as joints there let
// them; the next step takes that back before it begins (FreeMotion::late). In the first step all of them act by half.
// What resists a motion in the solve (geometric stiffness, lines, brakes) resists this one, too. It moves nothing: it
// is how a velocity is told. By the velocity of the middle, the energy of a ball of 2000 kg that rises at 3 m/s would
// be too large by 490 J at 1/60 s.
#pragma once
#include "solver/island.h"

namespace brickfall {

// For islands whose plan says so (SolvePlan::swings), after the motion is stored.
void finishSwings(Island& island, Ties& ties, StepContext& context);

// Motors turn its joints: its motion is no vibration.
bool isDriven(const Island& island, const StepContext& context);

// Swings that have been very slow lately fade, before a step: hinges rub a little. Motors turn against that.
void fadeSwing(Island& island, const StepContext& context, BodySet& bodies);

}  // namespace brickfall
