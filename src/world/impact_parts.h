// Into which parts impacts and turns cut an island's step, as far as that is known before anything is solved.
#pragma once
#include "solver/island.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

//! outer radii, in a step | too small: fast bodies are left whole; cost of debris
//! | too large: contacts found from so far away say little about the hit, which acts along the wrong line
constexpr double kFarWay = 4;

class ImpactParts {
 public:
  ImpactParts(const Registry& registry, const StepContext& context) : registry_(registry), context_(context) {}

  // Left whole are large islands, but not rows that pass blows on; islands with a body that moves far beyond its own
  // size; and islands that a kinematic body moves.
  bool mayBeCut(const Island& island) const;
  // Longest part (s) in which no body alone in contact turns visibly by more than kMostTurn, nor one on joints as these
  // see it.
  double longest(const Island& island) const;
  // Whether the core of a body would pass into another body in the next `dt` s, by StepContext::solved. Contacts do not
  // tell it: they may be wrong about a body that is still far away, or turns.
  bool runThrough(const Island& island, double dt, const Proximity& proximity) const;

 private:
  bool passesBlowsOn(const Island& island) const;
  bool foundExactly(const Island& island) const;
  Vec3 turnOf(BodyIndex body) const;

  const Registry& registry_;
  const StepContext& context_;
};

}  // namespace brickfall
