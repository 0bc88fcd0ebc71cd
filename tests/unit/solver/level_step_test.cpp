// All clusters of a level at once: the matrix against the forces that it stands for, the step against what it is to leave.
#include "solver/level_step.h"

#include <optional>

#include "solver/imbalance.h"
#include "support/test_island.h"

namespace brickfall::test {
namespace {

// A wall of blocks side by side and on top of each other (no bond), in which all forces are linear near where it is.
struct Wall : TestIsland {
  Wall(int columns, int courses, double friction = 0.6) {
    BodyIndex under = ground();
    std::vector<std::vector<BodyIndex>> rows;
    for (int row = 0; row < courses; row++) {
      rows.emplace_back();
      for (int c = 0; c < columns; c++) rows.back().push_back(brick({2 * kBrick.x * c, (2 * row + 1) * kBrick.y, 0}));
    }
    for (int row = 0; row < courses; row++)
      for (int c = 0; c < columns; c++) {
        BodyIndex own = rows[std::size_t(row)][std::size_t(c)];
        ContactIndex bed = touch(row == 0 ? under : rows[std::size_t(row) - 1][std::size_t(c)], own, float(friction));
        load(bed, (courses - row) * kBrickWeight, 1000 * unit(bed));
        if (c == 0) continue;
        ContactIndex head = touch(rows[std::size_t(row)][std::size_t(c) - 1], own, float(friction));
        load(head, kBrickWeight, 1000 * unit(head));
      }
    prepare();
    updateHierarchy(island(), context);
    island().hierarchy.refresh(island().masses);
    for (SolveMotion& m : island().motion) m = {};
    forces.emplace(island(), counts);
    forces->readAll();
  }
  const Level& level() { return island().hierarchy.levels[1]; }
  Wrenches residuals() {
    Wrenches out;
    for (const Cluster& c : level().clusters) out.push_back(residualOf(island(), level(), c));
    return out;
  }
  void moveClusters(const Wrenches& step, float part) {
    for (std::size_t c = 0; c < level().clusters.size(); c++) {
      const Cluster& cluster = level().clusters[c];
      for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
        const std::uint32_t body = level().bodies[k];
        island().motion[body].d +=
            (step[c].force + cross(step[c].torque, island().masses[body].position - cluster.centre)) * part;
        island().motion[body].th += step[c].torque * part;
      }
    }
    forces->readAgain();
  }
  // A push along x and z (N) on every body of the top course. Up to a newton or two all joints hold.
  void push(float force) {
    for (std::size_t i = 0; i < island().bodies.size(); i++)
      if (at(island().bodies[i]).position.y > 0.9 * top()) {
        island().masses[i].dFree += Vec3f{force / island().masses[i].mass, 0, force / island().masses[i].mass};
      }
    forces->readAgain();
  }
  double top() {
    double y = 0;
    for (BodyIndex body : island().bodies) y = std::max(y, at(body).position.y);
    return y;
  }
  SolveStatistics counts;
  std::optional<RowForces> forces;
};
double lengthOf(const Wrenches& x) { return std::sqrt(dotOf(x, x)); }

// Solved to a fifth: what a step of that size leaves of the residuals, read from the rows themselves.
TEST(LevelSystem, ItsSolutionIsThatOfTheForces) {
  for (auto [columns, courses] : {std::pair{6, 6}, std::pair{30, 4}, std::pair{4, 20}}) {
    Wall wall(columns, courses);
    wall.push(1);
    LevelSystem system(wall.island(), wall.island().hierarchy, 1);
    ASSERT_TRUE(system.make());
    Wrenches before = wall.residuals(), step;
    ASSERT_GT(lengthOf(before), 2);
    system.solve(before, step);
    EXPECT_GT(dotOf(before, step), 0) << "downwards";
    wall.moveClusters(step, 1);
    Wrenches left = wall.residuals();
    EXPECT_LT(std::sqrt(std::fabs(dotOf(left, step))), 0.3 * std::sqrt(dotOf(before, step)))
        << columns << " x " << courses;
    // Solved again from what is left, five times: the matrix is that of the forces, or this would not come to an end.
    for (int k = 0; k < 5; k++) {
      Wrenches now = wall.residuals();
      system.solve(now, step);
      wall.moveClusters(step, 1);
    }
    EXPECT_LT(lengthOf(wall.residuals()), 0.01 * lengthOf(before)) << columns << " x " << courses;
  }
}

// Without any rows' help from a coarser level, what a long wall does together takes as many iterations as it has clusters.
TEST(LevelSystem, LongWallsTakeNoMoreThanShortOnes) {
  double shares[2];
  int n = 0;
  for (int columns : {12, 96}) {
    Wall wall(columns, 4);
    wall.push(1);
    LevelSystem system(wall.island(), wall.island().hierarchy, 1);
    ASSERT_TRUE(system.make());
    Wrenches before = wall.residuals(), step;
    system.solve(before, step);
    wall.moveClusters(step, 1);
    shares[n++] = lengthOf(wall.residuals()) / lengthOf(before);
  }
  EXPECT_LT(shares[0], 0.5);
  EXPECT_LT(shares[1], 0.5);
}

TEST(LevelStep, EndsNearItsMinimumAndLeavesForcesReadThere) {
  Wall wall(12, 6);
  wall.push(1);
  Wrenches before = wall.residuals();
  LevelStep step(*wall.forces, wall.island().hierarchy, 1);
  step.apply();
  Wrenches left = wall.residuals();
  EXPECT_LT(lengthOf(left), 0.4 * lengthOf(before));
  wall.forces->readAgain();
  Wrenches again = wall.residuals();
  for (std::size_t c = 0; c < left.size(); c++) {
    EXPECT_EQ(left[c].force.x, again[c].force.x);
    EXPECT_EQ(left[c].torque.y, again[c].torque.y);
  }
  for (int k = 0; k < 4; k++) step.apply();
  EXPECT_LT(lengthOf(wall.residuals()), 0.02 * lengthOf(before));
}

// Pushed so hard that the whole wall slides and lifts off: the full step would be far too long, or its matrix of closed joints far
// too stiff. It must go down all the same, and nothing become other than a number.
TEST(LevelStep, GoesDownWhereJointsOpenAndSlide) {
  for (float force : {1e3f, -1e4f, 1e6f}) {
    Wall wall(12, 6);
    wall.push(force);
    double before = lengthOf(wall.residuals());
    LevelStep step(*wall.forces, wall.island().hierarchy, 1);
    for (int k = 0; k < 10; k++) step.apply();
    double after = lengthOf(wall.residuals());
    EXPECT_LT(after, before) << force;
    for (const SolveMotion& m : wall.island().motion) EXPECT_TRUE(std::isfinite(m.d.x) && std::isfinite(m.th.z));
  }
}

TEST(LevelStep, InBalanceNothingMoves) {
  Wall wall(12, 6);
  for (Wrench& r : wall.island().residual) r = {};
  LevelStep step(*wall.forces, wall.island().hierarchy, 1);
  step.apply();
  for (const SolveMotion& m : wall.island().motion) {
    EXPECT_EQ(length(m.d), 0);
    EXPECT_EQ(length(m.th), 0);
  }
}

}  // namespace
}  // namespace brickfall::test
