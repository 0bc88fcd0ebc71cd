// Elastic energy of contacts: for the ledger.
#pragma once
#include "solver/island.h"

namespace brickfall {

// J: elastic energy, which a compressed or sheared contact can still give back. The contact law is that of a spring of
// the point's stiffness k in which a force decays. Let g be the gap or drift at the end of a step and p the multiplier
// from that step. Then m = p + k g falls to a half in every step, whatever the motion (kCorrect = kMultiplierShare =
// 0.5). Let U = k g^2 / 2 + m^2 / (6 k). The work that the contact does in a step is at most the fall of U:
// docs/contact-energy.md has the proof. Plastic overlap stores nothing, nor does an open point. A point in an impact is
// softer than a resting one and turns plastic when the impact is over. So it counts with the energy of a resting point
// under the force that is then left, in the softest island (plan.h).
double elasticEnergy(const Contact& contact, const StepContext& context);

// J: what springs may give back of it in the next step, under the forces of the last one. A force counts up to its
// multiplier, or the weight of the heavier body: what is more is a blow's, and comes back by a rebound alone.
float energyToGiveBack(const Contact& contact, const StepContext& context);

}  // namespace brickfall
