// Eigenvalues and axes of symmetric matrices: rebuilt, right-handed, also where values coincide or scales differ widely.
#include "math/symmetric_eigen.h"

#include <gtest/gtest.h>

#include "support/random_geometry.h"

namespace brickfall {
namespace {

void expectDecomposed(const Mat3& m, double scale) {
  SymmetricEigen e = symmetricEigen(m);
  Mat3 back = transpose(e.axes) * (diagonal(e.values) * e.axes);
  for (int i = 0; i < 3; i++) {
    EXPECT_LE(length(back.row[i] - m.row[i]), 1e-14 * scale);
    EXPECT_NEAR(length(e.axes.row[i]), 1, 1e-15);
    EXPECT_NEAR(dot(e.axes.row[i], e.axes.row[(i + 1) % 3]), 0, 1e-15);
  }
  EXPECT_NEAR(determinant(e.axes), 1, 1e-14);
}

TEST(SymmetricEigen, RandomMatricesAreRebuilt) {
  Random random(1);
  for (int k = 0; k < 2000; k++) {
    Vec3 values = test::randomVector(random, 1);
    if (k % 4 == 1) values.y = values.x;
    if (k % 4 == 2) values = {1, 1 + 1e-13 * values.y, 1e-9 * values.z};
    if (k % 4 == 3) values = values * 1e-12;
    Mat3 turn = toMatrix(test::randomRotation(random));
    expectDecomposed(turn * (diagonal(values) * transpose(turn)), k % 4 == 3 ? 1e-12 : 1.8);
  }
}

TEST(SymmetricEigen, DiagonalMatricesKeepTheirOrderAndAxes) {
  SymmetricEigen e = symmetricEigen(diagonal(Vec3{3, 1, 2}));
  EXPECT_EQ(e.values, (Vec3{3, 1, 2}));
  for (int i = 0; i < 3; i++) EXPECT_EQ(e.axes.row[i], Mat3{}.row[i]);
  expectDecomposed(Mat3{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, 1);
  expectDecomposed(Mat3{{{1, 1e-300, 0}, {1e-300, 2, 0}, {0, 0, 3}}}, 1);
  expectDecomposed(Mat3{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, 3);
}

}  // namespace
}  // namespace brickfall
