// Bodies that hang on joints, at the end of a step.
//
// Their steps are those of a leapfrog: the solve finds the velocity of the middle of a step, and the place of its end.
// So that both are of one moment, forces give half of their impulses more where the step ends, as joints there let
// them; the next step takes that back before it begins (FreeMotion::late). In the first step all of them act by half.
// What resists a motion in the solve (geometric stiffness, lines, brakes) resists this one, too. It moves nothing: it
// is how a velocity is told. By the velocity of the middle, the energy of a ball of 2000 kg that rises at 3 m/s would
// be too large by 490 J at 1/60 s.
//
// What other ties press on these bodies goes along (VelocitySystem::findBodies); they hold it where they held it in the
// step, as firmly as joints do, but push by no more than half of what they gave. So it is the same whatever touches a
// linkage, and an impact is given once.
#pragma once
#include "solver/island.h"

namespace brickfall {

// For islands whose plan says so (SolvePlan::endVelocities): before free motions are found, what joints hold begins to
// swing by outside forces alone.
void beginSwings(const Island& island, const StepContext& context, BodySet& bodies);

// After the motion is stored and finished.
void finishSwings(Island& island, Ties& ties, StepContext& context);

// Motors turn its joints: its motion is no vibration.
bool isDriven(const Island& island, const StepContext& context);

// It has swung faster lately than what fades.
bool hasSwung(const Island& island);

// Swings that have been very slow lately fade, before a step: hinges rub a little. Motors turn against that.
void fadeSwing(Island& island, const StepContext& context, BodySet& bodies);

// A joint has a limit, or is a rope.
bool hasBounds(const Island& island);

}  // namespace brickfall
