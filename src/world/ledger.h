// The ledger of momentum and energy. The sums over the dynamic bodies are taken between the stages. The change that a
// stage made is booked on the cause that acts in it, by the function that stands beside the stage.
//
// Angular momentum is that about the world's origin. Until the solve it is taken where bodies are, from then on where
// they will be. A contact's impulse acts at the start of the step; velocities hold at its end. The difference between
// the two is the way times the momentum, d x m v. It is zero where d = v h. Where a body moves by the mean of two
// velocities, it is the angular momentum that impulses give by acting midway. It is booked on gravity in flight, and
// otherwise on the cause that acts on the body.
#pragma once
#include <cstddef>
#include <vector>

#include "brickfall/step_trace.h"
#include "dynamics/body_set.h"
#include "dynamics/ties.h"

namespace brickfall {

struct StepContext;

// Where the ledger of a step stands between two stages.
struct LedgerState {
  bool begun = false;           // a step was booked: the next one can be compared with `last`
  Balance now;                  // after the stage booked last
  Balance last;                 // after the last step
  BalanceChange push;           // of gravity and forces in this substep: the solve must answer it
  std::size_t quarantined = 0;  // bodies, when the substep began

  // Books on `cause` the change up to `after`; the second one, the change of elastic energy alone.
  void book(BalanceChange& cause, const Balance& after);
  void bookElastic(BalanceChange& cause, double after);
  // `sum` with the potential and elastic energy of now: places and contacts are still as they were.
  Balance moving(Balance sum) const;
};

BalanceChange operator-(const Balance& a, const Balance& b);
BalanceChange operator-(const BalanceChange& a, const BalanceChange& b);
void operator+=(BalanceChange& a, const BalanceChange& b);

void addBody(Balance& sum, const BodyMass& mass, Vec3 position, Vec3 velocity, Vec3 spin, Vec3 spinMomentum);
// Elastic energy of the ties that sleep.
double elasticAsleep(const StepContext& context);
// Balance of all dynamic bodies, where they are.
Balance balanceNow(const BodySet& bodies, const StepContext& context);
// Balance of the awake bodies as the solve left them, where they are at the end of the step.
Balance solvedBalance(const std::vector<BodyIndex>& awake, const BodySet& bodies, const StepContext& context);
// Books on `cause` the changes of the solved motions.
void bookSolved(BalanceChange& cause, const BodySet& bodies, const std::vector<BodyIndex>& awake,
                const StepContext& context, LedgerState& state);

}  // namespace brickfall
