// Where a world is in time, and in a call to step().
#pragma once
#include <cstdint>

namespace brickfall {

struct Clock {
  double time = 0;  // s
  std::uint64_t stepCount = 0;
  double lastDt = 0;       // s, of the last substep
  double stiffnessDt = 0;  // s: the time step of which resting contacts have their stiffness
  int steadySteps = 0;     // substeps in a row as long as the one before; counted no further than it matters
  double callDt = 0;       // s, of the whole call under way
  int part = 0;            // of it, from 0
  bool lastPart = true;    // of it

  // A substep begins. True if anything in units of its time step changed. (Parts of it, for a hit, change nothing in that.)
  bool beginSubstep(double dt);
};

}  // namespace brickfall
