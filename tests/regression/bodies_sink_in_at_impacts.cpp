// A body that went on to an impact ended where its points foretold, which are those of the start of the way: turned, or
// on another face, it was in the ground, and each impact let it in a little further. These worlds, drawn at random, were
// left with overlaps of 5 to 24 mm: a top on a plane, a plate that slaps down, a ball on hills.
#include "law/random_world.h"

#include <gtest/gtest.h>

namespace brickfall::law {

TEST(Regression, BodiesSinkInAtImpacts) {
  for (const auto& [kind, seed] :
       {std::pair{RandomKind::ground, 14589}, {RandomKind::ground, 8423}, {RandomKind::terrain, 5332}}) {
    RandomWorld random = drawWorld(kind, seed);
    const RandomOutcome found = runWorld(random);
    EXPECT_LT(found.deep, 0.1) << random.text;
    EXPECT_LE(found.gain, 1e-3) << random.text;
    EXPECT_EQ(found.through, 0) << random.text;
  }
}

}  // namespace brickfall::law
