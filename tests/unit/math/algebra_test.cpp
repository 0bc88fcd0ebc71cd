// Vectors, matrices, quaternions, transforms, boxes: each identity on random values.
#include <gtest/gtest.h>

#include "support/random_geometry.h"

namespace brickfall {
namespace {

using test::randomPose;
using test::randomRotation;
using test::randomVector;

Mat3 randomMatrix(Random& random) {
  Vec3 a = randomVector(random, 2), b = randomVector(random, 2);
  return {{a, b, randomVector(random, 2)}};
}

void expectNear(Vec3 a, Vec3 b, double tolerance) { EXPECT_LE(length(a - b), tolerance); }

TEST(Vec3, ProductsAndUnits) {
  Random random(1);
  for (int k = 0; k < 1000; k++) {
    Vec3 a = randomVector(random, 3), b = randomVector(random, 3), c = cross(a, b);
    EXPECT_NEAR(dot(c, a), 0, 1e-14);
    EXPECT_NEAR(dot(c, b), 0, 1e-14);
    EXPECT_NEAR(lengthSquared(c) + dot(a, b) * dot(a, b), lengthSquared(a) * lengthSquared(b), 1e-12);
    EXPECT_NEAR(length(normalized(a)), 1, 4e-16);
  }
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(normalized(Vec3{}), Vec3{});
}

TEST(Mat3, InverseTransposeAndDeterminant) {
  Random random(2);
  for (int k = 0; k < 1000; k++) {
    Mat3 m = randomMatrix(random), n = randomMatrix(random);
    Vec3 v = randomVector(random, 2);
    expectNear((m * n) * v, m * (n * v), 1e-13);
    expectNear(transposeTimes(m, v), transpose(m) * v, 0);
    EXPECT_NEAR(determinant(m * n), determinant(m) * determinant(n), 1e-11);
    if (std::fabs(determinant(m)) < 0.1) continue;
    expectNear(inverse(m) * (m * v), v, 1e-11);
  }
}

TEST(Quat, RotatesAsItsMatrixAndComposes) {
  Random random(3);
  for (int k = 0; k < 1000; k++) {
    Quat q = randomRotation(random), r = randomRotation(random);
    Vec3 v = randomVector(random, 5);
    expectNear(rotate(q, v), toMatrix(q) * v, 3e-14);
    expectNear(rotate(q * r, v), rotate(q, rotate(r, v)), 5e-14);
    expectNear(rotate(conjugate(q), rotate(q, v)), v, 3e-14);
    EXPECT_NEAR(determinant(toMatrix(q)), 1, 2e-15);
    EXPECT_NEAR(length(rotate(q, v)), length(v), 1e-14);
  }
}

TEST(Quat, IsRightHanded) {
  Quat quarter = quatFromAxisAngle({0, 1, 0}, 1.57079632679489661923);
  expectNear(rotate(quarter, Vec3{0, 0, 1}), {1, 0, 0}, 1e-15);
}

TEST(Transform, InverseAndProduct) {
  Random random(4);
  for (int k = 0; k < 1000; k++) {
    Transform a = randomPose(random, 10), b = randomPose(random, 10);
    Vec3 p = randomVector(random, 10);
    expectNear(transformPoint(a * b, p), transformPoint(a, transformPoint(b, p)), 1e-13);
    expectNear(transformPoint(inverse(a), transformPoint(a, p)), p, 1e-13);
  }
}

TEST(Aabb, TouchingOverlapsAndMergingContains) {
  Aabb a{{0, 0, 0}, {1, 1, 1}}, touching{{1, 0, 0}, {2, 1, 1}}, apart{{1.1, 0, 0}, {2, 1, 1}};
  EXPECT_TRUE(overlaps(a, touching));
  EXPECT_FALSE(overlaps(a, apart));
  EXPECT_TRUE(overlaps(grown(a, 0.2), apart));
  EXPECT_TRUE(contains(merged(a, apart), a));
  EXPECT_TRUE(contains(merged(a, apart), apart));
  EXPECT_FALSE(contains(a, apart));
  EXPECT_TRUE(contains(a, a));
}

}  // namespace
}  // namespace brickfall
