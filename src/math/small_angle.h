// Sine and cosine of |x| <= pi/4, for numbers and for lanes of them. Taylor series with enough terms for an error below half a
// unit in the last place of 1.
#pragma once

namespace brickfall {

template <class T> inline T sineSmall(T x) {
  T z = x * x;
  T p = T(-1.0 / 1307674368000.0);
  p = p * z + T(1.0 / 6227020800.0);
  p = p * z - T(1.0 / 39916800.0);
  p = p * z + T(1.0 / 362880.0);
  p = p * z - T(1.0 / 5040.0);
  p = p * z + T(1.0 / 120.0);
  p = p * z - T(1.0 / 6.0);
  return x + x * z * p;
}

template <class T> inline T cosineSmall(T x) {
  T z = x * x;
  T p = T(1.0 / 20922789888000.0);
  p = p * z - T(1.0 / 87178291200.0);
  p = p * z + T(1.0 / 479001600.0);
  p = p * z - T(1.0 / 3628800.0);
  p = p * z + T(1.0 / 40320.0);
  p = p * z - T(1.0 / 720.0);
  p = p * z + T(1.0 / 24.0);
  return T(1) - T(0.5) * z + z * z * p;
}

}  // namespace brickfall
