// A body gets the motion that the solve found for it.
#pragma once
#include "solver/step_context.h"

namespace brickfall {

// Sets pose and velocities by StepContext::solved. Returns false, and leaves the body as it was, if they are not sane.
bool moveBody(BodyIndex body, BodySet& bodies, const StepContext& context);

}  // namespace brickfall
