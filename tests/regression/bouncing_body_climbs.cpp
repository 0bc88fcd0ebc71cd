// A body alone of restitution near 1 that turned as it bounced was sent up to forty times as high as its energy goes: the
// last check took all of its velocity, but left it where its way had ended. Worlds drawn at random, on a plate, a wall, a
// belt and hills.
#include "law/random_world.h"

#include <gtest/gtest.h>

namespace brickfall::law {

TEST(Regression, BouncingBodyClimbs) {
  for (const auto& [kind, seed] : {std::pair{RandomKind::plate, 5973},
                                   {RandomKind::wall, 2148},
                                   {RandomKind::belt, 2549},
                                   {RandomKind::belt, 8069},
                                   {RandomKind::terrain, 11136}})
    expectNothingFromNothing(kind, seed);
}

}  // namespace brickfall::law
