// How stiff the points of a contact are: everything that decides it. In units u = effective mass / dt^2, so that a step
// of any length stops bodies that meet within it.
#pragma once
#include "solver/island.h"

namespace brickfall {

// Scale of the thinner one of the two bodies, of those that can move.
Scale scaleOfPair(const Contact& pair, const StepContext& context);

// N/m, of each point of a contact in this step.
struct PairStiffness {
  float unit;
  float full;     // of a resting point
  float soft;     // of an impact, at least
  float deepest;  // m: how far an impact may press the two bodies into each other
  float dt;       // s
  Scale scale;    // of the pair

  // Stiffness of a point born in an impact at `approach` (m/s; negative = closing). At k units it stops after approach
  // dt / (1 + k): as soft as possible, but no softer than the bodies are thick.
  float ofImpact(float approach) const;
  bool isFull(float stiffness) const { return stiffness >= (1 - float(kTrifle)) * full; }
  bool isAboveFull(float stiffness) const { return stiffness > (1 + float(kTrifle)) * full; }
};

// `debris`: the pair is as soft as in an impact.
PairStiffness stiffnessOf(const Contact& pair, bool debris, const Island& island, const StepContext& context);
// N/m: of a resting point, in the softest island.
double leastStiffness(const Contact& pair, const StepContext& context);

}  // namespace brickfall
