// The verdict of libccd: do two convex shapes overlap?
#pragma once
#include "geometry/shape.h"

namespace brickfall::oracle {

bool ccdOverlap(const Shape& a, const Shape& b, const Transform& bInA);  // not for planes

}  // namespace brickfall::oracle
