// The impacts of one moment: velocities change, no time passes.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/island.h"

namespace brickfall {

// When, in the rest of the island's step, its first open point closes, s; none: infinity. By StepContext::solved, which is how
// the island would go on over Island::dt if its open points were not there.
double firstClosing(const Island& island, const StepContext& context);
// A point that carried nothing in the last step, was not hit in this one, and is further apart than what counts as closed.
bool isOpen(const Contact& c, int i, const StepContext& context);
// Prepared rows of an island: its open points carry nothing in the coming solve, and stay as fresh as they were.
void leaveOut(Island& island, Ties ties, const StepContext& context);

struct ContactImpact {
  std::uint32_t row = 0;
  double speed = 0;    // m/s, fastest approach of its points
  double impulse = 0;  // N s, that stopped it: rebound left out
};

// Changes the velocities of the island's bodies by the impacts of the points that are closed, with friction and rebound: those
// nearer than 20 micrometres, or than their approach takes them in `blink` s. Points that are hit are fresh afterwards.
// Returns false, and changes nothing, if its solve left more than a hundredth of the forces unbalanced, or energy would rise.
bool solveImpact(Island& island, Ties ties, BodySet& bodies, StepContext& context, double blink,
                 SolveStatistics& statistics, std::pmr::vector<ContactImpact>& impacts);

}  // namespace brickfall
