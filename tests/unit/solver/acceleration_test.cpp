// Where the changes of the last cycles lead, against the law that defines it.
#include "solver/acceleration.h"

#include <optional>

#include "math/random.h"
#include "support/test_island.h"

namespace brickfall::test {
namespace {

// A pile that has long stood under its load: near where it is, all its forces are linear.
struct Standing : TestIsland {
  explicit Standing(int bricks) {
    BodyIndex under = ground();
    pile(under, bricks);
    island();
    int above = bricks;
    for (ContactIndex k : island().rows.contacts.tieOf) load(k, above-- * kBrickWeight, 1000 * unit(k));
    prepare();
    for (SolveMotion& m : island().motion) m = {};
    forces.emplace(island(), counts);
    forces->readAll();
  }
  // A change of all bodies by up to `size` m and as many rad/m of turn.
  std::vector<SolveMotion> change(Acceleration& acceleration, Random& random, double size) {
    std::vector<SolveMotion> way(island().bodies.size());
    auto number = [&] { return float(random.between(-size, size)); };
    acceleration.begin();
    for (std::size_t i = 0; i < way.size(); i++) {
      way[i].d = {number(), number(), number()};
      way[i].th = {number(), number(), number()};
      island().motion[i].d += way[i].d;
      island().motion[i].th += way[i].th;
    }
    forces->readAgain();
    acceleration.end();
    return way;
  }
  double slope(const std::vector<SolveMotion>& way) {
    double sum = 0;
    for (std::size_t i = 0; i < way.size(); i++)
      sum += double(dot(way[i].d, island().residual[i].force)) + double(dot(way[i].th, island().residual[i].torque));
    return sum;
  }
  SolveStatistics counts;
  std::optional<RowForces> forces;
};

// A brick 0.1 mm over the ground of which a cycle has made one change.
struct OverGround : OnGround {
  explicit OverGround(Vec3f change) : OnGround({}, 1e-4) {
    prepare();
    for (SolveMotion& m : island().motion) m = {};
    forces.emplace(island(), counts);
    forces->readAll();
    acceleration.emplace(island());
    acceleration->begin();
    island().motion[0].d = change;
    forces->readAgain();
    acceleration->end();
  }
  SolveStatistics counts;
  std::optional<RowForces> forces;
  std::optional<Acceleration> acceleration;
};

TEST(Acceleration, EndsAcrossAllChangesWhereForcesAreLinear) {
  Random random(5);
  for (int bricks : {25, 60, 150})
    for (int changes : {1, 2, 3}) {
      Standing lab(bricks);
      Acceleration acceleration(lab.island());
      std::vector<std::vector<SolveMotion>> ways;
      for (int k = 0; k < changes; k++) ways.push_back(lab.change(acceleration, random, 2e-8));
      double before = 0;
      for (auto& way : ways) before = std::max(before, std::fabs(lab.slope(way)));
      acceleration.apply(*lab.forces);
      for (auto& way : ways) EXPECT_LT(std::fabs(lab.slope(way)), 1e-3 * before) << bricks << ", " << changes;
    }
}

// The first is made whole by what it led to, the second stands across that: both are needed to end across four.
TEST(Acceleration, KeepsWhatEarlierOnesFound) {
  Random random(6);
  Standing lab(40);
  Acceleration other(lab.island()), acceleration(lab.island());
  lab.change(other, random, 2e-8);  // what is to be found
  std::vector<SolveMotion> first = lab.change(acceleration, random, 2e-8);
  double before = std::fabs(lab.slope(first));
  acceleration.apply(*lab.forces);
  std::vector<SolveMotion> second = lab.change(acceleration, random, 2e-8);
  acceleration.apply(*lab.forces);
  EXPECT_LT(std::fabs(lab.slope(first)), 2e-3 * before);
  EXPECT_LT(std::fabs(lab.slope(second)), 2e-3 * before);
}

TEST(Acceleration, AChangeMadeTwiceCountsOnce) {
  Random random(7);
  Standing lab(10);
  Acceleration acceleration(lab.island());
  std::vector<SolveMotion> way = lab.change(acceleration, random, 2e-8);
  acceleration.begin();
  for (std::size_t i = 0; i < way.size(); i++) {
    lab.island().motion[i].d += way[i].d;
    lab.island().motion[i].th += way[i].th;
  }
  lab.forces->readAgain();
  acceleration.end();
  double before = std::fabs(lab.slope(way));
  acceleration.apply(*lab.forces);
  EXPECT_LT(std::fabs(lab.slope(way)), 1e-3 * before);
}

// A brick in the air knows of no ground: its changes would take it a whole step's fall down, through 0.1 mm of air and far on.
TEST(Acceleration, DoesNotEndFarBeyondWhatItMeets) {
  OverGround lab({0, -1e-5f, 0});
  Island& island = lab.island();
  const float weight = island.residual[0].force.y;
  ASSERT_LT(weight, 0);
  lab.acceleration->apply(*lab.forces);
  EXPECT_LT(island.motion[0].d.y, -1e-5f) << "it goes on";
  EXPECT_GT(island.motion[0].d.y, -2e-4f) << "and is met by the ground; free fall is 2.7 mm";
  EXPECT_LT(island.residual[0].force.y, -0.5f * weight) << "and not thrown back by it";
}

// Forces that a float cannot hold: the island stays where it was, to the last bit.
TEST(Acceleration, WhatEndsNowhereIsTakenBack) {
  OverGround lab({3e-6f, -1e-5f, 0});
  Island& island = lab.island();
  const Vec3f place = island.motion[0].d, left = island.residual[0].force;
  island.residual[0].force.y = -1e37f;
  lab.acceleration->apply(*lab.forces);
  EXPECT_EQ(island.motion[0].d, place);
  EXPECT_EQ(island.motion[0].th, Vec3f{});
  EXPECT_EQ(island.residual[0].force, left);
  EXPECT_EQ(lab.counts.lightVisits, 4.0 * 5) << "it was tried: twice, and read again where it was";
}

TEST(Acceleration, NothingHappensBeforeTheFirstChangeNorByNone) {
  Standing lab(3);
  Acceleration acceleration(lab.island());
  for (SolveMotion& m : lab.island().motion) m.d.x = 1e-6f;
  lab.forces->readAgain();
  acceleration.apply(*lab.forces);
  EXPECT_EQ(lab.island().motion[0].d.x, 1e-6f);
  acceleration.begin();
  acceleration.end();
  acceleration.apply(*lab.forces);
  for (std::size_t i = 0; i < 3; i++) EXPECT_EQ(lab.island().motion[i].d.x, 1e-6f);
}

}  // namespace
}  // namespace brickfall::test
