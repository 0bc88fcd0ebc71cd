// A body as the solve sees it: its unknowns, its constants during a step, what is out of balance.
#pragma once
#include "math/float3.h"

namespace brickfall {

// The unknowns of a body: displacement and turn of this step. The only thing that a body step writes.
struct alignas(32) SolveMotion {
  Vec3f d;
  float pad0 = 0;
  Vec3f th;
  float pad1 = 0;
};
static_assert(sizeof(SolveMotion) == 32);

// Constants of a body during a step. d and dFree are relative to the island's own rigid motion.
struct alignas(64) SolveMass {
  float mass = 0;         // m / dt^2, kg/s2
  float inertia[6] = {};  // I / dt^2, world axes: xx yx yy zx zy zz
  Vec3f dFree, thFree;
  Vec3f position;  // m, from the island's origin
};
static_assert(sizeof(SolveMass) == 64);

struct Wrench {
  Vec3f force, torque;
};

// Inertia's part of a body's residual: M (dFree - d) / dt^2, I (thFree - th) / dt^2.
inline Wrench inertiaResidual(const SolveMass& m, const SolveMotion& motion) {
  Vec3f e = m.dFree - motion.d, t = m.thFree - motion.th;
  return {e * m.mass,
          {m.inertia[0] * t.x + m.inertia[1] * t.y + m.inertia[3] * t.z,
           m.inertia[1] * t.x + m.inertia[2] * t.y + m.inertia[4] * t.z,
           m.inertia[3] * t.x + m.inertia[4] * t.y + m.inertia[5] * t.z}};
}

}  // namespace brickfall
