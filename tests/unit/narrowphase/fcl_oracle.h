// Verdicts of the Flexible Collision Library, apart because its headers are slow to compile.
#pragma once
#include "brickfall/math.h"

namespace brickfall::test {

bool fclBoxesOverlap(Vec3 halfA, Vec3 halfB, const Transform& bInA);

}  // namespace brickfall::test
