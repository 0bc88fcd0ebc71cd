// The step of an island as one list: what a part of it leaves out, and that what is settled is passed over.
#include "solver/island_step.h"

#include "support/test_island.h"

namespace brickfall {
namespace {

using namespace test;

SolveStatistics stepPart(TestIsland& lab, IslandPart part, double dt) {
  SolveStatistics statistics;
  stepIsland(lab.island(), part, dt, lab.ties(), lab.bodies, lab.context, statistics);
  return statistics;
}

TEST(IslandStep, APartUpToAnImpactDoesNotSeeWhatIsOpen) {
  for (IslandPart part : {IslandPart::last, IslandPart::toImpact, IslandPart::flight}) {
    OnGround lab({0, -1, 0}, 1e-3);
    lab.link();
    stepPart(lab, part, lab.context.dt);
    const double fall = lab.context.dt + kG * lab.context.dt * lab.context.dt / 2,
                 way = -lab.context.solved[lab.body].d.y;
    if (part == IslandPart::last)
      EXPECT_LT(way, 0.1 * fall) << "the ground stops it";
    else
      EXPECT_GT(way, 0.999 * fall);
    EXPECT_EQ(lab.island().part, IslandPart::last) << "the next part is what is left, unless it is said";
  }
}

TEST(IslandStep, OnlyTheLastPartMayRest) {
  for (IslandPart part : {IslandPart::last, IslandPart::between}) {
    OnGround lab;
    lab.load(lab.face, kBrickWeight, 1e4 * lab.unit(lab.face));
    lab.link();
    const SolveStatistics statistics = stepPart(lab, part, lab.context.dt);
    EXPECT_EQ(lab.island().resting(), part == IslandPart::last);
    EXPECT_EQ(statistics.cycles == 0, part == IslandPart::last);
  }
}

TEST(IslandStep, ASettledIslandIsPassedOver) {
  OnGround lab;
  for (int i = 0; i < 60; i++) lab.step();
  ASSERT_TRUE(lab.island().settled());
  const Contact before = lab.contact(lab.face);
  const int resting = lab.context.statistics.restingIslands;
  const double visits = lab.context.statistics.lightVisits;
  lab.step();
  EXPECT_EQ(lab.island().ending, IslandEnding::settled);
  EXPECT_EQ(lab.context.statistics.restingIslands, resting + 1);
  EXPECT_EQ(lab.context.statistics.lightVisits, visits) << "nothing of it is read";
  EXPECT_EQ(lab.contact(lab.face).points.gap[0], before.points.gap[0]);
}

}  // namespace
}  // namespace brickfall
