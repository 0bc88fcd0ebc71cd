// The sweeps, short. `make validate` has them at full length.
#include "sweep.h"

#include <gtest/gtest.h>

namespace brickfall {
namespace {

TEST(ObbSweep, OneInstant) { test::sweepOneInstant(200000); }
TEST(ObbSweep, FirstContact) { test::sweepFirstContact(40000); }

}  // namespace
}  // namespace brickfall
