// Where the load of mortar goes that opens: what its neighbours bear before and after. Nothing that moves a body reads
// it.
#pragma once
#include "dynamics/ties.h"
#include "solver/step_context.h"
#include "world/activity.h"

namespace brickfall {

// Once a step, after the solve is stored and before broken joints are taken out. `time`: s, at the end of the
// step; the context is that of this part of it.
void noteOpenings(double time, const StepContext& context, const Activity& activity, Ties& ties);
// The joint breaks in this step.
void noteBreak(MortarIndex mortar, double time, MortarSet& set);

}  // namespace brickfall
