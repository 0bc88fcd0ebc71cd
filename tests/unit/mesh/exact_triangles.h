// Whether two triangles with whole-number corners share a point, by another way than the library's and without rounding.
#pragma once
#include "brickfall/geometry/triangle_mesh.h"

namespace brickfall::test {

// How two triangles meet. Corners: whole numbers within +-2^13.
enum class Meeting { apart, coplanarApart, touch, coplanar, cross };
Meeting exactMeeting(const Triangle& a, const Triangle& b);

}  // namespace brickfall::test
