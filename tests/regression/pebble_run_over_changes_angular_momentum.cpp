// A pebble that something heavier ran over within a step, unseen by contacts, was moved along with it. Angular momentum was off
// by up to 0.0025 of the largest momentum of a body. Worlds of law 18u.
#include "law/random_world.h"

namespace brickfall {
namespace {

TEST(Regression, PebbleRunOverKeepsAngularMomentum) {
  for (int seed : {263, 780, 907, 1187, 1672, 1697}) {
    law::RandomWorld random = law::drawWorld(law::RandomKind::space, seed);
    const law::RandomOutcome found = law::runWorld(random);
    EXPECT_LE(found.angular, 1e-9) << random.text;
    EXPECT_LE(found.linear, 1e-9) << random.text;
    EXPECT_LE(found.gain, 1e-6) << random.text;
  }
}

}  // namespace
}  // namespace brickfall
