// Quantities that are frozen in a solve, and follow what it finds: rebounds by the impulse that stopped each impact,
// and caps of what breaks. Nothing but these is then out of balance, and the solve goes on.
#pragma once

namespace brickfall {

struct Island;
struct StepContext;

enum class Renewal {
  within,  // the cycles go on: not all is in balance yet
  first,   // after the first solve
  again    // after one that went on
};

//! - | too small: joints that break take more than their energy; new points slide under limits that are not theirs
//! | too large: cost of steps in which much breaks; friction limits and forces chase each other
constexpr int kMostRenewals = 6;  // of what is frozen, in a solve; and so many direct steps renew friction limits

//! - | too small: stacks that land, or are made leaning, shear; limits and ropes hold what parts
//! | too large: cost; joints gain energy
constexpr int kBoundRounds = 3;  // so often a direct solve begins anew: with the friction limits of the forces that it
                                 // found, and without one-sided ties that would pull

class Renewals {
 public:
  // Sets them anew. True if any changed; false for ever after so many times.
  bool next(Island& island, const StepContext& context, Renewal when);

 private:
  int made_ = 0;
};

}  // namespace brickfall
