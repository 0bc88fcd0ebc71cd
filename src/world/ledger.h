// Where the ledger of a step stands between two stages.
#pragma once
#include <cstddef>

#include "brickfall/step_trace.h"

namespace brickfall {

struct LedgerState {
  bool begun = false;           // a step was booked: the next one can be held against `last`
  Balance now;                  // after the stage booked last
  Balance last;                 // after the last step
  BalanceChange push;           // of gravity and forces in this substep: what the solve must answer
  std::size_t quarantined = 0;  // bodies, when the stage began

  // Books on `cause` what was changed up to `after`; of elastic energy alone.
  void book(BalanceChange& cause, const Balance& after);
  void bookElastic(BalanceChange& cause, double after);
  // With the motion of `sum`, while places and joints are still as they were.
  Balance moving(Balance sum) const;
};

}  // namespace brickfall
