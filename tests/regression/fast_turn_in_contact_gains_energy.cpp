// A pebble stuck to a body that tumbled by 3 rad in each step. The solve sees half a radian of such a turn, along the spin of the
// start: off the way that a free turn takes. There the same momentum is another energy. The two had 0.21 % more after a step;
// a rebound between them, of a thousandth of that, let it pass the last check. A world of law 18u.
#include "law/random_world.h"

namespace brickfall {
namespace {

TEST(Regression, FastTurnInContactGainsNothing) {
  law::RandomWorld random = law::drawWorld(law::RandomKind::space, 1017);
  EXPECT_LE(law::runWorld(random).gain, 1e-6) << random.text;
}

// A rebound that worked against a body that turned by radians counted as energy that its contacts had given: 15 % in a step.
TEST(Regression, ReboundThatTakesGivesNothing) {
  law::RandomWorld random = law::drawWorld(law::RandomKind::plate, 3408);
  EXPECT_LE(law::runWorld(random).gain, 1e-6) << random.text;
}

// Two boxes that a hit turned by 9 rad in the step: where such a turn ends, the same momentum was four times the energy. 1.4 %.
TEST(Regression, EnergyOfAFastTurnIsThatOfItsStart) {
  law::RandomWorld random = law::drawWorld(law::RandomKind::space, 3298);
  EXPECT_LE(law::runWorld(random).gain, 1e-6) << random.text;
}

// Bodies of millimetres that go by the metre, past each other: contacts found from afar pressed with arms of decimetres. What
// that gave, no motion of the bodies against each other could give back: .2, .9 and 5.7 % of all energy.
TEST(Regression, BodiesThatPassGiveEachOtherNoSpin) {
  for (int seed : {15420, 6062, 8540}) {
    law::RandomWorld random = law::drawWorld(law::RandomKind::space, seed);
    EXPECT_LE(law::runWorld(random).gain, 1e-6) << random.text;
  }
}

}  // namespace
}  // namespace brickfall
