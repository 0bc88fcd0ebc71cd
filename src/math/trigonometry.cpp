// Sine, cosine and arc functions of the same bits everywhere: only + - * / and sqrt, which IEEE 754 defines exactly.
#include "brickfall/math.h"
#include "math/small_angle.h"

namespace brickfall {

namespace {

constexpr double kHalfPi = 1.57079632679489655800e+00;
// pi/2 in two parts (Cody and Waite 1980): the first has 33 bits, so up to 2^20 times it is exact.
constexpr double kHalfPiHigh = 0x1.921fb54400000p+0;
constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;
constexpr double kLargestAngle = 1e5;
constexpr double kSmallAngle = 0.78;  // rad, under pi/4: no quarter turns to take off

// atan of 0 <= x <= 1, by halving the angle three times, then the series.
double arcTangentUnit(double x) {
  x = x / (1 + std::sqrt(1 + x * x));
  x = x / (1 + std::sqrt(1 + x * x));
  x = x / (1 + std::sqrt(1 + x * x));
  // Divided by the compiler, which would not at the step's level of optimisation: 1/27, ... 1/3, 1.
  constexpr double kSeries[] = {-1.0 / 27, 1.0 / 25,  -1.0 / 23, 1.0 / 21, -1.0 / 19, 1.0 / 17, -1.0 / 15,
                                1.0 / 13,  -1.0 / 11, 1.0 / 9,   -1.0 / 7, 1.0 / 5,   -1.0 / 3, 1.0};
  double z = x * x, p = 0;
  for (double term : kSeries) p = term + z * p;
  return 8 * x * p;
}

}  // namespace

void sinCos(double radians, double& sine, double& cosine) {
  if (std::fabs(radians) < kSmallAngle) {  // most of what a step asks for: the same bits without the division
    sine = sineSmall(radians);
    cosine = cosineSmall(radians);
    return;
  }
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
