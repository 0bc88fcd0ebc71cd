// The time of a world, and how far a call to step() has come.
#pragma once
#include <cstdint>

namespace brickfall {

struct Clock {
  double time = 0;  // s
  std::uint64_t stepCount = 0;
  double lastDt = 0;       // s, of the last substep
  double stiffnessDt = 0;  // s: the time step that the stiffness of resting contacts is made for
  int steadySteps = 0;     // substeps in a row as long as the one before; not counted beyond kSteadySteps
  double rings = 0;        // s: no longer is the next part of a step (HitPart::rings); 0: as long as the step
  double callDt = 0;       // s, of the whole call under way
  int part = 0;            // of the call, from 0
  bool lastPart = true;    // of the call

  // A substep begins. True if any quantity in units of its time step changed. (A substep made in parts, for a hit,
  // changes none of them.)
  bool beginSubstep(double dt);
};

}  // namespace brickfall
