// Blows: bodies that meet what something of limited strength holds, as mortar does, meet that body alone. A hit lasts a
// millisecond. What holds the body gives no impulse in that time; over a step of a sixtieth of a second it would give
// seventeen times as much as it can.
#pragma once
#include <memory_resource>
#include <vector>

#include "brickfall/step_trace.h"
#include "dynamics/ties.h"
#include "solver/tie_report.h"

namespace brickfall {

struct Island;
struct StepContext;

struct Blows {
  explicit Blows(std::pmr::memory_resource* memory) : impacts(memory) {}
  std::pmr::vector<TieImpact> impacts;  // of this step, to be told
  BalanceChange change;                 // of the bodies' momenta and energy
};

// Before the step of an island is prepared. Changes velocities.
void giveBlows(Island& island, Ties& ties, BodySet& bodies, const StepContext& context);

}  // namespace brickfall
