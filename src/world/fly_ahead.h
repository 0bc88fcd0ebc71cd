// Bodies that fly far in a step, to near what they will hit there.
#pragma once
#include "brickfall/step_report.h"
#include "solver/island.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

//! outer radii | too small: bodies meet before their contacts are found | too large: hits act along the wrong line
constexpr double kShortOf = 0.1;  // so far from what it meets a flight ahead ends

// The line of a contact force serves both bodies, and runs where they are at the start of the step. From afar that is
// not where they meet. So a body of the island that goes further than four times its outer radius, and touches nothing,
// flies to where the ball around it would touch something. StepContext::ahead says how much of the step that took; the
// rest of its way is cut by that (stage_obstacles.cpp).
void flyAhead(const Island& island, Registry& registry, Proximity& proximity, Ties& ties, StepContext& context,
              StepReport& report);

}  // namespace brickfall
