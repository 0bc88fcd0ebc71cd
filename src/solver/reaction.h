// How a row of any kind acts at the present motion. A row ties two bodies at its centre. Let u be their relative
// displacement there and w their relative turn (both of B against A, world axes). The row answers with a force and a
// torque about the centre and, where a Newton step needs it, with its stiffness against u and w.
#pragma once
#include <cstdint>

#include "math/wide.h"

namespace brickfall {

// The two bodies that a row ties, in Island::motion: partners come after the island's own.
struct RowEnds {
  std::uint32_t a = 0, b = 0;
};

// N: the force with which a row pressed B in the last step, and the largest friction that it allowed along its surface.
struct RowGrip {
  Vec3 force;
  double friction = 0;
};

// From the bodies' centres of mass to the row's centre.
struct Arms {
  wide::V a, b;
};

// The action on B (the opposite on A), with the arms from the bodies' centres of mass to the row's centre. World axes,
// N and N m.
struct Reaction {
  wide::V force, torque;
  wide::V armA, armB;
};

// A row's action as it was last read: on B, about the row's centre.
struct Reading {
  wide::V force, torque;
};

// By rows: [A B; B^T C], A and C symmetric. For one row, or for two side by side (math/wide_pair.h).
template <class L> struct StiffnessOf { L A[3], B[3], C[3]; };
using Stiffness = StiffnessOf<wide::V>;

// A reaction for a Newton step.
struct StiffReaction : Reaction {
  Stiffness stiffness;
};

}  // namespace brickfall
