// Portable trigonometry against the long double functions of the C library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_geometry.h"

namespace brickfall {
namespace {

constexpr double kPi = 3.14159265358979323846;

double sinCosError(double angle) {
  double s, c;
  sinCos(angle, s, c);
  return double(std::max(std::fabs(s - std::sin((long double)angle)), std::fabs(c - std::cos((long double)angle))));
}

TEST(SinCos, WithinTwoUlpsOverTheWholeRange) {
  double worst = 0;
  for (double range : {1e-3, 1.0, 10.0, 1e3, 1e5}) {
    for (int k = -50000; k <= 50000; k++) worst = std::max(worst, sinCosError(range * k / 50000));
  }
  Random random(1);
  for (int k = 0; k < 500000; k++) worst = std::max(worst, sinCosError(random.between(-1e5, 1e5)));
  EXPECT_LT(worst, 2e-16);
  RecordProperty("worst", std::to_string(worst * 1e16) + "e-16");
}

TEST(SinCos, NextToMultiplesOfAQuarterTurn) {
  for (int k = -60000; k <= 60000; k += 7) {
    double angle = k * (kPi / 4);
    for (double a : {angle, std::nextafter(angle, 1e9), std::nextafter(angle, -1e9)}) EXPECT_LT(sinCosError(a), 2e-16);
  }
}

TEST(SinCos, ExactValuesAndSymmetry) {
  double s, c;
  sinCos(0, s, c);
  EXPECT_EQ(s, 0);
  EXPECT_EQ(c, 1);
  Random random(2);
  for (int k = 0; k < 10000; k++) {
    double angle = random.between(0, 100), s1, c1, s2, c2;
    sinCos(angle, s1, c1);
    sinCos(-angle, s2, c2);
    EXPECT_NEAR(s1, -s2, 2e-16);
    EXPECT_NEAR(c1, c2, 2e-16);
    EXPECT_NEAR(s1 * s1 + c1 * c1, 1, 4e-16);
  }
}

TEST(RotationVector, RoundTrip) {
  Random random(3);
  for (int k = 0; k < 100000; k++) {
    double angle = k % 3 == 0 ? random.between(0, kPi) : k % 3 == 1 ? kPi - random.between(0, 1e-6) : 1;
    if (k % 3 == 2) {
      for (int j = int(random.below(20)); j > 0; j--) angle *= 0.1;
    }
    Vec3 v = test::randomDirection(random) * angle;
    Quat q = quatFromRotationVector(v);
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-15);
    Vec3 back = rotationVector(q);
    // At half a turn both signs of the axis are right.
    double error = std::min(length(back - v), length(back + v) + 2 * (kPi - angle));
    EXPECT_LE(error, 2e-15 * (1 + angle)) << "angle " << angle;
    EXPECT_LE(length(back), kPi + 1e-15);
    if (angle < 1e-2) {
      EXPECT_LE(length(back - v), 1e-15 * angle);
    }
    Vec3 negated = rotationVector({-q.x, -q.y, -q.z, -q.w});
    EXPECT_LE(length(negated - back), 4e-16 * (1 + angle));
  }
}

TEST(RotationVector, AgreesWithLibmAndAxisAngle) {
  Random random(4);
  for (int k = 0; k < 20000; k++) {
    Vec3 axis = test::randomDirection(random);
    double angle = random.between(-20, 20);
    Quat q = quatFromAxisAngle(axis, angle), r = quatFromRotationVector(axis * angle);
    EXPECT_NEAR(q.w, std::cos(angle / 2), 1e-15);
    EXPECT_NEAR(q.x, axis.x * std::sin(angle / 2), 1e-15);
    EXPECT_NEAR(q.w, r.w, 4e-15);
    EXPECT_NEAR(q.y, r.y, 4e-15);
    if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
    double expected = 2 * std::atan2(length(Vec3{q.x, q.y, q.z}), q.w);
    EXPECT_NEAR(length(rotationVector(q)), expected, 2e-15);
  }
}

TEST(RotationVector, AnyFiniteVectorGivesARotation) {
  Random random(5);
  for (double size : {0.0, 1e-320, 1e-160, 1e-8, 9.99e-5, 1.01e-4, 1e5, 1e6, 1e100, 1e200, 1.7e308}) {
    for (int k = 0; k < 100; k++) {
      Quat q = quatFromRotationVector(test::randomDirection(random) * size);
      ASSERT_TRUE(isFinite(q)) << size;
      EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-15) << size;
    }
  }
}

}  // namespace
}  // namespace brickfall
