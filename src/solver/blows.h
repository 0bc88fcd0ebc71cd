// Blows: bodies that meet what something of limited strength holds, as mortar does, meet that body alone. A hit lasts a
// millisecond. What holds the body gives no impulse in that time; over a step of a sixtieth of a second it would give
// seventeen times as much as it can.
#pragma once
#include <memory_resource>
#include <vector>

#include "base/function_ref.h"
#include "brickfall/step_trace.h"
#include "dynamics/ties.h"
#include "solver/tie_report.h"

namespace brickfall {

struct Island;
struct StepContext;

// N, J: of what holds a body, before it gives way along a direction.
struct Holding {
  double force = 0, energy = 0;
};

// The bodies that something of limited strength holds, and how it does.
struct Held {
  const std::pmr::vector<char>& bodies;  // by body in Island::motion: 1
  FunctionRef<Holding(std::uint32_t body, Vec3 along)> holding;
};

// A held body was struck by something round: what holds it takes so many times its energy, since the blow crushes.
struct Crush {
  std::uint32_t body = 0;  // in Island::motion
  double tougher = 1;
};

struct Blows {
  explicit Blows(std::pmr::memory_resource* memory) : crushes(memory), impacts(memory) {}
  std::pmr::vector<Crush> crushes;      // of this step
  std::pmr::vector<TieImpact> impacts;  // of this step, to be told
  BalanceChange change;                 // of the bodies' momenta and energy
};

// Before a part of the step of an island is prepared. In its last part, changes velocities; in the others, tells what
// impacts at their moment have crushed.
void giveBlows(Island& island, bool last, Ties& ties, BodySet& bodies, const StepContext& context);

}  // namespace brickfall
