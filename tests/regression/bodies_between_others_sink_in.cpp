// What ended aside was fitted in as if its neighbours could not move, nor what flew or was stopped on its way without a
// contact: it stayed in one or the other, or came out at the far side of what is thin. Worlds drawn at random: two that
// meet in space (left 57 mm deep in each other); a plate between a body and the ground, a ball that another one presses
// into a belt, two that arrive at a belt or at hills at once, one whose end is in hills where its core was stopped (all
// went through).
#include "law/random_world.h"

#include <gtest/gtest.h>

namespace brickfall::law {

TEST(Regression, BodiesBetweenOthersSinkIn) {
  for (const auto& [kind, seed] : {std::pair{RandomKind::space, 10527},
                                   {RandomKind::ground, 11093},
                                   {RandomKind::belt, 4165},
                                   {RandomKind::belt, 14620},
                                   {RandomKind::terrain, 15859},
                                   {RandomKind::terrain, 111},
                                   {RandomKind::plate, 32358},
                                   {RandomKind::wall, 33906},
                                   {RandomKind::wall, 30171}})
    expectNothingFromNothing(kind, seed);
}

}  // namespace brickfall::law
