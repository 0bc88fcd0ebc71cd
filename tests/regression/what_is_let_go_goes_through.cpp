// A group for which the last check finds no momenta goes on freely: that way nobody had looked along, and it led through
// what is thin. And of a group that a rising belt meets in flight, the belt took along nobody: it went over them. Worlds
// drawn at random, on a plate, belts and hills.
#include "law/random_world.h"

#include <gtest/gtest.h>

namespace brickfall::law {

TEST(Regression, WhatIsLetGoGoesThrough) {
  for (const auto& [kind, seed] : {std::pair{RandomKind::plate, 15669},
                                   {RandomKind::belt, 10380},
                                   {RandomKind::belt, 35168},
                                   {RandomKind::terrain, 34261}})
    expectNothingFromNothing(kind, seed);
}

}  // namespace brickfall::law
