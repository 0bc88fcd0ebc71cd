// Mass, centre and inertia of shapes and of bodies made of several.
#pragma once
#include <span>
#include <string>

#include "brickfall/body.h"
#include "geometry/shape.h"

namespace brickfall {

// In the shape's frame. Planes have none (mass 0). density kg/m3.
MassProperties shapeMass(const Shape& shape, double density);
// Of what is distributed as `atOne` has it at a density of 1 kg/m3; none: of the solid shape.
MassProperties shapeMass(const Shape& shape, double density, const MassProperties* atOne);
// "" if mass can lie so within these bounds (of the shape, in its frame); else what is wrong with it.
std::string impossibleMass(const MassProperties& properties, const Aabb& bounds);
// The same seen from the frame in which the shape has the pose `pose`.
MassProperties transformed(const MassProperties& properties, const Transform& pose);
MassProperties combined(std::span<const MassProperties> parts);

}  // namespace brickfall
