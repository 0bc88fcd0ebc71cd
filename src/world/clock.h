// Where a world is in time, and in a call to step().
#pragma once
#include <cstdint>

namespace brickfall {

struct Clock {
  double time = 0;  // s
  std::uint64_t stepCount = 0;
  double lastDt = 0;        // s, of the last part of a step
  double jointDt = 0;       // s: the time step of which resting joints have their stiffness
  int steadySteps = 0;      // parts in a row as long as the one before; counted no further than it matters
  double callDt = 0;        // s, of the whole call under way
  int substep = 0;          // of it, from 0
  bool lastSubstep = true;  // of it

  // A part begins. True if anything in units of its time step changed.
  bool beginPart(double dt);
};

}  // namespace brickfall
