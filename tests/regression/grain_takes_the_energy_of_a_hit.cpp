// What an impact takes and gives back later was shared out by the head: a grain of 0.1 mg that lay beside two heavy bodies
// could take 90 kJ of theirs, and left the world. And a body that was fitted in beside one that falls paid for its way as
// seen from that one: it ended faster. Worlds drawn at random, on hills.
#include "law/random_world.h"

#include <gtest/gtest.h>

namespace brickfall::law {

TEST(Regression, GrainTakesTheEnergyOfAHit) {
  for (int seed : {2895, 4608}) expectNothingFromNothing(RandomKind::terrain, seed);
}

}  // namespace brickfall::law
