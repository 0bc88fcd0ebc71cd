// Sine, cosine and arc functions of the same bits everywhere: only + - * / and sqrt, which IEEE 754 defines exactly.
// Polynomials: Taylor series with enough terms for |x| <= pi/4 (error below half a unit in the last place of 1).
#include "brickfall/math.h"

namespace brickfall {

namespace {

constexpr double kHalfPi = 1.57079632679489655800e+00;
// pi/2 in two parts (Cody and Waite 1980): the first has 33 bits, so up to 2^20 times it is exact.
constexpr double kHalfPiHigh = 0x1.921fb54400000p+0;
constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;
constexpr double kLargestAngle = 1e5;

double sineSmall(double x) {
  double z = x * x;
  double p = -1.0 / 1307674368000.0;
  p = p * z + 1.0 / 6227020800.0;
  p = p * z - 1.0 / 39916800.0;
  p = p * z + 1.0 / 362880.0;
  p = p * z - 1.0 / 5040.0;
  p = p * z + 1.0 / 120.0;
  p = p * z - 1.0 / 6.0;
  return x + x * z * p;
}

double cosineSmall(double x) {
  double z = x * x;
  double p = 1.0 / 20922789888000.0;
  p = p * z - 1.0 / 87178291200.0;
  p = p * z + 1.0 / 479001600.0;
  p = p * z - 1.0 / 3628800.0;
  p = p * z + 1.0 / 40320.0;
  p = p * z - 1.0 / 720.0;
  p = p * z + 1.0 / 24.0;
  return 1 - 0.5 * z + z * z * p;
}

// atan of 0 <= x <= 1, by halving the angle twice, then the series.
double arcTangentUnit(double x) {
  x = x / (1 + std::sqrt(1 + x * x));
  x = x / (1 + std::sqrt(1 + x * x));
  x = x / (1 + std::sqrt(1 + x * x));
  double z = x * x, p = 0;
  for (int k = 27; k >= 1; k -= 2) p = (k % 4 == 1 ? 1.0 : -1.0) / k + z * p;
  return 8 * x * p;
}

}  // namespace

void sinCos(double radians, double& sine, double& cosine) {
  double turns = std::floor(radians / kHalfPi + 0.5);
  double x = (radians - turns * kHalfPiHigh) - turns * kHalfPiLow;
  double s = sineSmall(x), c = cosineSmall(x);
  double quarter = turns - 4 * std::floor(turns / 4);  // 0, 1, 2, 3, or NaN
  sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
  cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
}

Quat quatFromRotationVector(Vec3 v) {
  double angle = length(v);
  if (!(angle <= kLargestAngle)) {  // beyond, a double hardly knows the angle; its square may overflow
    Vec3 size = abs(v);
    double largest = size.x > size.y ? size.x : size.y;
    v = normalized(v * (1 / (largest > size.z ? largest : size.z))) * kLargestAngle;
    angle = kLargestAngle;
  }
  double s = 0.5 - angle * angle / 48, c = 1 - angle * angle / 8;  // series, exact to rounding below 1e-4
  if (angle >= 1e-4) {
    sinCos(0.5 * angle, s, c);
    s /= angle;
  }
  return normalized(Quat{v.x * s, v.y * s, v.z * s, c});
}

Vec3 rotationVector(Quat q) {
  if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
  Vec3 v{q.x, q.y, q.z};
  double s = length(v);
  if (s < 1e-9) return v * 2.0;
  double half = s <= q.w ? arcTangentUnit(s / q.w) : kHalfPi - arcTangentUnit(q.w / s);
  return v * (2 * half / s);
}

Quat quatFromAxisAngle(Vec3 unitAxis, double radians) {
  double s, c;
  sinCos(0.5 * radians, s, c);
  return normalized(Quat{unitAxis.x * s, unitAxis.y * s, unitAxis.z * s, c});
}

}  // namespace brickfall
