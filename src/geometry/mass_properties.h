// Mass, centre and inertia of shapes and of bodies made of several.
#pragma once
#include <span>

#include "brickfall/body.h"
#include "geometry/shape.h"

namespace brickfall {

// In the shape's frame. Planes have none (mass 0). density kg/m3.
MassProperties shapeMass(const Shape& shape, double density);
// The same seen from the frame in which the shape has the pose `pose`.
MassProperties transformed(const MassProperties& properties, const Transform& pose);
MassProperties combined(std::span<const MassProperties> parts);

}  // namespace brickfall
