// The torque-free turn of a rigid body.
#pragma once
#include "brickfall/math.h"

namespace brickfall {

// Principal axes of inertia (rows, in body axes) and the inverse of the inertia about each, 1 / (kg m2).
struct PrincipalInertia {
  Mat3 axes;
  Vec3 inverse;
};
// Of a regular, symmetric inertia.
PrincipalInertia principalInertia(const Mat3& inertia);

// Turns a rigid body freely for dt: angular momentum is kept to rounding, energy to fourth order in the turn per substep.
// Symmetric splitting into turns about the principal axes (McLachlan 1993; Dullweber, Leimkuhler and McLachlan 1997), five
// of them to a substep for fourth order (Suzuki 1990).
Quat turnFreely(Quat rotation, Vec3 angularMomentum, const PrincipalInertia& inertia, double dt);

// Several bodies side by side, each to the bits that it would get alone: one turn is a chain of divisions and roots in which
// the processor waits for each. Bodies that spin very fast, or about one axis exactly, are turned alone.
constexpr int kTurnsAtOnce = 4;
struct FreeTurn {
  Quat rotation;  // in: at the start; out: at the end
  Vec3 angularMomentum;
  PrincipalInertia inertia;
};
void turnFreely(FreeTurn* turns, int count, double dt);  // count <= kTurnsAtOnce

}  // namespace brickfall
