// A grain of 3 mg met a body of half a tonne in space at 400 m/s. Contacts were as firm as between bodies of 5 kg, as
// under a load, though nothing bore one: the rebound began with the heavy body thrown aside, floats lost the grain's share of
// the forces, and it was put in quarantine. A world drawn at random.
#include "law/random_world.h"

#include <gtest/gtest.h>

namespace brickfall::law {

TEST(Regression, GrainIsLostInAHit) { expectNothingFromNothing(RandomKind::space, 80348); }

}  // namespace brickfall::law
