// What contacts hold, and the work that they do: for the ledger.
#pragma once
#include "brickfall/step_trace.h"
#include "solver/island.h"

namespace brickfall {

// J, what a compressed or sheared contact can still give back. The contact law is that of a spring of the point's stiffness k
// in which a force decays: with gap or drift g at the end of a step and h the multiplier from it, m = h + k g falls to a
// half in every step whatever the motion (kCorrect = kMultiplierShare = 0.5), and with U = k g^2 / 2 + m^2 / (6 k) the work that
// the contact does in a step is at most what U falls by: docs/step.md has the proof. Overlap that is plastic holds nothing,
// nor does an open point. A point in an impact is softer than a resting one and turns plastic when the impact is over: it
// holds what a resting one does under the force that is then left, in the softest island (plan.h).
double elasticEnergy(const Contact& contact, const StepContext& context);

// Of all contacts of an island, by the motion that the solve found: between forces and new poses.
struct ContactWork {
  double work = 0;     // J, done on the bodies and on kinematic partners
  double rebound = 0;  // J, done by what rebounds gave: not part of `work`
  double elastic = 0;  // J, held after it
};
ContactWork contactWork(const Island& island, const StepContext& context);

// What fixed and kinematic bodies gave to the island in the step, about the world's origin; its work is that of their
// motion.
BalanceChange supportImpulses(const Island& island, const StepContext& context);

}  // namespace brickfall
