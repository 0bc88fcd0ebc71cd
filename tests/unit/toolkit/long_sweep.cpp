// The sweeps of sweep_test.cpp at ten times the length: part of `make validate`.
#include <gtest/gtest.h>

#include "sweep.h"

namespace brickfall {
namespace {

TEST(ObbLongSweep, OneInstant) { test::sweepOneInstant(2000000); }
TEST(ObbLongSweep, FirstContact) { test::sweepFirstContact(400000); }

}  // namespace
}  // namespace brickfall
