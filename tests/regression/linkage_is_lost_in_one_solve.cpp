// A link of sixteen milligrams that a hit had spun was jammed between its joint and a body. Each round of the solve
// turned it further, to where its joint could not reach, by forces a hundred times as large. It ended at 10^14 m/s; the
// last check took 10^15 J, and six bodies were lost.
#include "law/random_linkage.h"

#include <algorithm>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

TEST(Regression, LinkageIsLostInOneSolve) {
  law::RandomLinkage linkage = law::drawLinkage(law::LinkageKind::hangs, 717);
  double moved = 0, taken = 0;
  for (int i = 0; i < linkage.steps; i++) {
    Result<StepReport> report = linkage.world.step(linkage.dt, linkage.substeps);
    ASSERT_TRUE(report.ok() && report->quarantined.empty()) << "step " << i;
    moved = std::max(moved, linkage.world.energy().kinetic);
    taken = std::max(taken, report->energyTaken);
  }
  EXPECT_LT(taken, 2 * moved);
}

}  // namespace
}  // namespace brickfall
