// Each law in `cases` worlds drawn at random: time steps from 1/30 to 1/480 s, whole or in parts; the world turned,
// mirrored, 100 m and 1 km from the origin; bodies of 1 cm to 10 m, all shapes and densities. A few in `make test`, many in
// `make validate`. The worst case of each time step is reported.
#pragma once

namespace brickfall::law {

void sweepSticking(int cases);        // row 1
void sweepSliding(int cases);         // row 2
void sweepTilting(int cases);         // row 3
void sweepStopping(int cases);        // row 4
void sweepRolling(int cases);         // row 5
void sweepBouncing(int cases);        // row 6
void sweepRocking(int cases);         // row 7
void sweepTumbling(int cases);        // row 8
void sweepOverhangs(int cases);       // row 9
void sweepColumns(int cases);         // row 10
void sweepCrashes(int cases);         // row 11
void sweepWalls(int cases);           // row 13
void sweepHeavyTops(int cases);       // row 15
void sweepFalls(int cases);           // row 15a
void sweepToppling(int cases);        // row 15a
void sweepLandings(int cases);        // row 15b
void sweepDrag(int cases);            // row 17
void sweepRandomWorlds(int cases);    // row 18u; cases of each kind
void sweepRandomLinkages(int cases);  // row 30t; cases of each kind
// At three steps, turned or not, bodies made in three orders: 18 cases.
void sweepCouplets(int cases);        // row 31a
void sweepWrenches(int cases);        // row 31b
void sweepTriplets(int cases);        // row 31c
void sweepOpenings(int cases);        // row 31d
void sweepBreakOuts(int cases);       // row 31e
void sweepPiers(int cases);           // row 31m
void sweepPushedWalls(int cases);     // row 31n
void sweepShearWalls(int cases);      // row 31v
void sweepHeldShearWalls(int cases);  // row 31y
void sweepBoulders(int cases);        // row 31y
void sweepPanels(int cases);          // row 31y

}  // namespace brickfall::law
