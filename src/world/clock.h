// Where a world is in time, and in a call to step().
#pragma once
#include <cstdint>

namespace brickfall {

struct Clock {
  double time = 0;  // s
  std::uint64_t stepCount = 0;
  double lastDt = 0;        // s, of the last part of a step
  double callDt = 0;        // s, of the whole call under way
  int substep = 0;          // of it, from 0
  bool lastSubstep = true;  // of it
};

}  // namespace brickfall
