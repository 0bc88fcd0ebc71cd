// A few random worlds for each law; `make validate` goes through many.
#include <gtest/gtest.h>

#include "law/sweeps.h"

namespace brickfall::law {
namespace {

TEST(LawAnywhere, Row1Sticking) { sweepSticking(20); }
TEST(LawAnywhere, Row2Sliding) { sweepSliding(20); }
TEST(LawAnywhere, Row3Tilting) { sweepTilting(10); }
TEST(LawAnywhere, Row4Stopping) { sweepStopping(20); }
TEST(LawAnywhere, Row5Rolling) { sweepRolling(30); }
TEST(LawAnywhere, Row6Bouncing) { sweepBouncing(40); }
TEST(LawAnywhere, Row7Rocking) { sweepRocking(20); }
TEST(LawAnywhere, Row8Tumbling) { sweepTumbling(10); }
TEST(LawAnywhere, Row9Overhangs) { sweepOverhangs(16); }
TEST(LawAnywhere, Row10Columns) { sweepColumns(16); }
TEST(LawAnywhere, Row11Crashes) { sweepCrashes(10); }
TEST(LawAnywhere, Row13Walls) { sweepWalls(10); }
TEST(LawAnywhere, Row15HeavyTops) { sweepHeavyTops(16); }
TEST(LawAnywhere, Row15aFalls) { sweepFalls(6); }
TEST(LawAnywhere, Row15aToppling) { sweepToppling(20); }
TEST(LawAnywhere, Row15bLandings) { sweepLandings(6); }
TEST(LawAnywhere, Row17Drag) { sweepDrag(20); }
TEST(LawAnywhere, Row18uNothingFromNothing) { sweepRandomWorlds(150); }
TEST(LawAnywhere, Row30tLinkagesGainNothing) { sweepRandomLinkages(12); }
TEST(LawAnywhere, Row31aCouplets) { sweepCouplets(2); }
TEST(LawAnywhere, Row31bWrenches) { sweepWrenches(2); }
TEST(LawAnywhere, Row31cTriplets) { sweepTriplets(2); }
TEST(LawAnywhere, Row31dOpenings) { sweepOpenings(2); }
TEST(LawAnywhere, Row31mPiers) { sweepPiers(1); }
TEST(LawAnywhere, Row31nPushedWalls) { sweepPushedWalls(1); }
TEST(LawAnywhere, Row31vShearWalls) { sweepShearWalls(1); }

}  // namespace
}  // namespace brickfall::law
