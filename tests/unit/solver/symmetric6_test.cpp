// The 6 x 6 factor and solve in float against plain elimination in double.
#include "solver/symmetric6.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"

namespace brickfall {
namespace {

// B B^T + diagonal: positive definite, as stiffness plus inertia is.
void randomSystem(Random& random, double spread, double m[6][6]) {
  double b[6][6];
  for (auto& row : b)
    for (double& x : row) x = random.between(-1, 1);
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++) {
      m[i][j] = i == j ? 0.1 : 0;
      for (int k = 0; k < 6; k++) m[i][j] += b[i][k] * b[j][k];
    }
  // turns are counted in other units than moves
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++) m[i][j] *= (i >= 3 ? spread : 1) * (j >= 3 ? spread : 1);
}

void solveInDouble(double m[6][6], const double* right, double* x) {
  double a[6][7];
  for (int i = 0; i < 6; i++) {
    std::copy(m[i], m[i] + 6, a[i]);
    a[i][6] = right[i];
  }
  for (int c = 0; c < 6; c++) {
    int best = c;
    for (int r = c; r < 6; r++)
      if (std::fabs(a[r][c]) > std::fabs(a[best][c])) best = r;
    std::swap(a[c], a[best]);
    for (int r = 0; r < 6; r++) {
      if (r == c) continue;
      double f = a[r][c] / a[c][c];
      for (int k = c; k < 7; k++) a[r][k] -= f * a[c][k];
    }
  }
  for (int i = 0; i < 6; i++) x[i] = a[i][6] / a[i][i];
}

TEST(Symmetric6, SolvesAsDoubleDoes) {
  Random random(1);
  double worst = 0;
  for (int n = 0; n < 2000; n++) {
    double spread = n % 2 ? 1 : 0.03, m[6][6], right[6], wanted[6];
    randomSystem(random, spread, m);
    for (double& r : right) r = random.between(-1, 1);
    Symmetric6 s;
    for (int i = 0; i < 6; i++)
      for (int j = 0; j <= i; j++) m[i][j] = m[j][i] = s.at(i, j) = float(m[i][j]);
    for (double& r : right) r = float(r);
    solveInDouble(m, right, wanted);
    ASSERT_TRUE(s.factor());
    Wrench x = s.solve(
        {{float(right[0]), float(right[1]), float(right[2])}, {float(right[3]), float(right[4]), float(right[5])}});
    double found[6] = {x.force.x, x.force.y, x.force.z, x.torque.x, x.torque.y, x.torque.z};
    double size[2] = {0, 0};
    for (int i = 0; i < 6; i++) size[i / 3] = std::max(size[i / 3], std::fabs(wanted[i]));
    for (int i = 0; i < 6; i++) worst = std::max(worst, std::fabs(found[i] - wanted[i]) / size[i / 3]);
  }
  EXPECT_LT(worst, 2e-3) << "relative error; conditions up to some thousands";
}

TEST(Symmetric6, RefusesWhatIsNotPositiveDefinite) {
  Symmetric6 zero;
  EXPECT_FALSE(zero.factor());
  Symmetric6 negative;
  for (int i = 0; i < 6; i++) negative.at(i, i) = i == 4 ? -1.0f : 1.0f;
  EXPECT_FALSE(negative.factor());
  Symmetric6 nan;
  for (int i = 0; i < 6; i++) nan.at(i, i) = 1;
  nan.at(5, 2) = std::nanf("");
  EXPECT_FALSE(nan.factor());
}

}  // namespace
}  // namespace brickfall
