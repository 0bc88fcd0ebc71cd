// The engine's steps against the converged ones, at full length: walls of a thousand bricks, hits, many piles, other time
// steps. For `make validate`; scenes_test.cpp says what is expected of each.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "ledger.h"

namespace brickfall::oracle {
namespace {

TEST(ConvergedStepAtLength, WallsOfAThousand) {
  Ledger l = look("40 courses of 25", fromLab("w40"), 0.5, 6);
  l.add(look("40 courses of 25, gaps of 0.1 mm", walls(40, 25, 1e-4, 1), 0.6, 12));
  l.add(look("pyramid of 40 rows", pyramid(40), 0.5, 6));
  EXPECT_GE(l.of(Ending::exhausted).islands, 1);  // measured 2
  EXPECT_GE(l.of(Ending::rested).islands, 1);
}

TEST(ConvergedStepAtLength, SmallWallsAtEveryTimeStep) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240})
    for (int seed : {1, 2, 3}) {
      Ledger l = look("10 courses of 10, gaps of 0.1 mm, seed " + std::to_string(seed), walls(10, 10, 1e-4, seed, dt),
                      1, int(std::lround(0.05 / dt)));
      EXPECT_GE(l.islands, 5) << "before they settle";
    }
}

TEST(ConvergedStepAtLength, PilesAtEveryTimeStep) {
  Ledger all;
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240})
    for (Litter kind : {Litter::boxes, Litter::hulls, Litter::spheres, Litter::capsules, Litter::mixed}) {
      Ledger l;
      for (std::uint64_t seed : {11, 12, 13}) {
        Trial trial = pile(kind, 40, seed);
        trial.dt = dt;
        l.add(follow(std::move(trial), 2, int(std::lround(0.1 / dt))));
      }
      const char* names[] = {"boxes", "hulls", "spheres", "capsules", "shapes of all kinds"};
      conclude(std::string("three piles of 40 ") + names[int(kind)], dt, l);
      all.add(l);
    }
  all.print("all piles");
  EXPECT_GE(all.sticking, 10000);
  EXPECT_GE(all.sliding, 10000);
  EXPECT_GE(all.opening, 1000);
  EXPECT_GE(all.closing, 5000);
}

TEST(ConvergedStepAtLength, Hits) {
  Ledger l = look("ball of 16.7 kg at 10 m/s into 40 courses of 25", fromLab("hole10"), 0.3, 5);
  l.add(look("ball of 4 t at 80 m/s into 40 courses of 25", fromLab("hitv80"), 0.2, 4));
  EXPECT_GE(l.closing, 10000);
}

}  // namespace
}  // namespace brickfall::oracle
