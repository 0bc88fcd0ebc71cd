// The oracle itself: its forces are the gradient of its energy, its solution is the only one, and what can be worked out by
// hand comes out.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"
#include "support/newton_probe.h"
#include "support/world_helpers.h"

namespace brickfall::oracle {
namespace {

// Islands of a falling pile: all regimes at once.
std::vector<Problem> problems() {
  std::vector<Problem> out;
  Trial trial = pile(Litter::mixed, 40, 11);
  for (int step = 0; step < 60; step++) {
    if (step % 6 == 0)
      probeStep(trial.world, trial.dt, [&](const SolvedIsland& s) {
        if (s.problem.bodies.size() > 2) out.push_back(s.problem);
      });
    EXPECT_TRUE(trial.world.step(trial.dt).ok());
  }
  return out;
}

std::vector<Motion> moved(std::vector<Motion> x, Random& random, double distance) {
  for (Motion& m : x) {
    m.d += test::randomVector(random, distance);
    m.th += test::randomVector(random, distance);
  }
  return x;
}

TEST(Newton, ForcesAreTheGradientOfTheEnergy) {
  Random random(31);
  int slopes = 0;
  for (const Problem& p : problems()) {
    std::vector<Motion> x = moved(solveFrozen(p).motion, random, 1e-3);
    std::vector<Load> r = residuals(p, x);
    for (int n = 0; n < 20; n++, slopes++) {
      std::vector<Motion> along = moved(std::vector<Motion>(x.size()), random, 1), plus = x, minus = x;
      double step = 1e-7, wanted = 0, size = 0;
      for (std::size_t i = 0; i < x.size(); i++) {
        plus[i].d += along[i].d * step;
        plus[i].th += along[i].th * step;
        minus[i].d -= along[i].d * step;
        minus[i].th -= along[i].th * step;
        wanted -= dot(r[i].force, along[i].d) + dot(r[i].torque, along[i].th);
        size += length(r[i].force) + length(r[i].torque);
      }
      double slope = (stepEnergy(p, plus) - stepEnergy(p, minus)) / (2 * step);
      ASSERT_NEAR(slope, wanted, 2e-4 * size);
    }
  }
  EXPECT_GE(slopes, 200);
}

TEST(Newton, SolutionIsTheMinimumAndTheOnlyOne) {
  Random random(32);
  int compared = 0;
  for (const Problem& p : problems()) {
    Solution s = solveFrozen(p);
    ASSERT_TRUE(s.converged) << s.left.worst();
    double least = stepEnergy(p, s.motion);
    for (double distance : {1e-2, 1e-4, 1e-6}) {
      std::vector<Motion> other = moved(s.motion, random, distance);
      EXPECT_GT(stepEnergy(p, other), least);
      // Strict convexity: how far a motion may be from the solution follows from its residual alone. Where no point is closed
      // it is just as far, but for rounding.
      EXPECT_LE(deviationOf(p, other, s.motion).mean, (1 + 1e-12) * (imbalanceAt(p, other).mean + s.left.mean));
      compared++;
    }
  }
  EXPECT_GE(compared, 30);
}

// A box let down on the ground without overlap: it sinks until its springs carry it. By hand: 4 k d = m g + m d / h^2 ...
TEST(Newton, BoxOnTheGroundSinksAsItsSpringsSay) {
  World world = test::awakeWorld();
  test::addGround(world);
  test::addBox(world, {0.2, 0.1, 0.3}, {0, 0.1, 0});
  int seen = 0;
  probeStep(world, test::kDt, [&](const SolvedIsland& s) {
    Solution exact = solveFrozen(s.problem);
    const ProblemBody& b = s.problem.bodies[0];
    ASSERT_EQ(s.problem.points.size(), 4u);
    double h2 = test::kDt * test::kDt, k = s.problem.points[0].k;
    for (const ProblemPoint& p : s.problem.points) EXPECT_EQ(p.k, k);
    EXPECT_NEAR(exact.motion[0].d.y, -b.mass * 9.81 / (4 * k + b.mass / h2), 1e-12);
    EXPECT_LT(length(exact.motion[0].th), 1e-12);
    seen++;
  });
  EXPECT_EQ(seen, 1);
}

}  // namespace
}  // namespace brickfall::oracle
