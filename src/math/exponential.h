// Exponential and logarithm of the same bits on every platform (no libm), to a few units of the last place.
#pragma once
#include <cmath>

namespace brickfall {

// x > 0 and finite. By the fraction's distance from 1: ln m = 2 artanh((m - 1) / (m + 1)).
inline double naturalLog(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) m *= 2, exponent--;
  const double s = (m - 1) / (m + 1), square = s * s;
  double sum = 0;
  for (int k = 21; k >= 1; k -= 2) sum = sum * square + 1.0 / k;
  return 2 * s * sum + exponent * 0.69314718055994531;
}

// |x| <= 700. By the rest that whole powers of 2 leave, as a power series.
inline double exponential(double x) {
  const double power = std::floor(x * 1.4426950408889634 + 0.5);
  const double rest = (x - power * 0.693147180369123816) - power * 1.90821492927058770e-10;  // ln 2 in two parts
  double sum = 1;
  for (int k = 14; k >= 1; k--) sum = 1 + sum * rest / k;
  return std::ldexp(sum, int(power));
}

}  // namespace brickfall
