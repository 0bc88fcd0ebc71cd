// Of two that met in the last look along ways each ended its own. The one rested, and its island has no groups: the
// program read the group of a body where there was none.
#include <gtest/gtest.h>

#include "law/random_world.h"

namespace brickfall::law {

TEST(Regression, RestingBodyInTheWayCrashes) { expectNothingFromNothing(RandomKind::terrain, 14088); }

}  // namespace brickfall::law
