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

// The step that changes velocities, and what of it rows expect.
struct StepSpan {
  double dt;          // s
  double before = 0;  // s, of the last step, half of which velocities are late; 0: they are not
  bool arcs = false;  // the body is alone, and turns about its points
};

// How velocities of a body change; zero for a fixed body.
struct VelocityChange {
  Vec3 move, turn;  // m/s of the centre of mass; rad/s
};
// Of the two bodies of a row.
struct EndChanges {
  VelocityChange a, b;
};

// How the forces of a row go through a step, by the change of its bodies' velocities.
enum class RowCourse : std::uint8_t {
  idle,    // it carries none
  goesOn,  // they go on as they are
  changes  // they begin or end within the step
};

// N, sums over rows: friction along a direction.
struct FrictionAlong {
  double limit = 0;  // the largest that the rows allow
  double given = 0;  // that acted on the body
  double goes = 0;   // W: the limits, times how fast their points go that way; of what rolls the body, along its face
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

// How a row resists a Newton step.
enum class Resist : std::uint8_t {
  nearly,    // open points nearby resist, too, and points of mortar at a cap by their secants
  exactly,   // by its law, as it is at this motion
  bySecants  // the same, but what slides or yields by its secant: no step jumps to and fro over where it holds
};

// By rows: [A B; B^T C], A and C symmetric. For one row, or for two side by side (math/wide_pair.h).
template <class L> struct StiffnessOf { L A[3], B[3], C[3]; };
using Stiffness = StiffnessOf<wide::V>;
// The same in doubles, by columns.
using BodyBlock = double[6][6];
inline void write(const Stiffness& s, BodyBlock& K) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      K[i][j] = double(s.A[i][j]);
      K[i][j + 3] = K[j + 3][i] = double(s.B[i][j]);
      K[i + 3][j + 3] = double(s.C[i][j]);
    }
}

// A reaction for a Newton step.
struct StiffReaction : Reaction {
  Stiffness stiffness;
};

}  // namespace brickfall
