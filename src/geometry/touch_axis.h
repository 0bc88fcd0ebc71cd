// Two convex shapes of which one is a cylinder or cone: along which direction they are furthest apart or overlap least.
#pragma once
#include <optional>

#include "geometry/shape.h"

namespace brickfall {

struct TouchAxis {
  Vec3 normal;            // unit, from a to b, frame of a
  double separation = 0;  // m along it, of the surfaces; negative: overlap
  Vec3 onA, onB;          // on the surfaces, `separation` apart
};

// Nothing where they are further apart than `margin`. Neither is a plane or a mesh.
std::optional<TouchAxis> findTouchAxis(const Shape& a, const Shape& b, const Transform& bInA, double margin);

}  // namespace brickfall
