// A hit between two groups that the contacts of the step have not seen.
#pragma once
#include "solver/step_context.h"

namespace brickfall {

// From `rest` of the step before its end, the centre of a light body, which has stopped there, goes on with a heavy one
// that flies, wherever that is. Both momenta of the two stay as they are. To be called in the order of such hits.
void hitPlastically(BodyIndex light, BodyIndex heavy, double rest, StepContext& context);

}  // namespace brickfall
