// Into which parts an island's step is cut by impacts and turns, as far as that is known before anything is solved.
#pragma once
#include "solver/island.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

class ImpactParts {
 public:
  ImpactParts(const Registry& registry, const StepContext& context) : registry_(registry), context_(context) {}

  // Left whole are large islands, what moves far beyond its own size, and what something kinematic moves.
  bool mayBeCut(const Island& island) const;
  // s: nothing in contact turns visibly by more than kMostTurn.
  double longest(const Island& island) const;
  // By StepContext::solved, `dt` s further: whether the core of a body would pass into something on its way. Contacts
  // of what is still far, or turns, may lie.
  bool runThrough(const Island& island, double dt, const Proximity& proximity) const;

  //! - | too small: quick series of impacts end first order | too large: cost
  static constexpr int kMostImpacts = 8;  // of an island in a step
  //! - | too small: the fastest tops fall | too large: cost
  static constexpr int kMostTurnParts = 24;  // of a step

 private:
  bool foundExactly(const Island& island) const;
  bool onMesh(const Island& island) const;
  Vec3 turnOf(BodyIndex body) const;

  const Registry& registry_;
  const StepContext& context_;
};

}  // namespace brickfall
