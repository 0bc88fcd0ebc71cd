// The largest of some numbers that may not be numbers.
#pragma once

namespace brickfall {

// Keeps NaN, wherever among the values it comes: what is not a number is under no limit.
inline void takeLarger(double& largest, double value) {
  if (!(value <= largest) && largest == largest) largest = value;
}

}  // namespace brickfall
