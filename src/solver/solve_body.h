// A body as the solve sees it: its unknowns, its constants during a step, its residual. It is laid out to be read and
// written as four lanes. Numbers that are written one by one and read as lanes at once make the reading wait for the
// store.
#pragma once
#include "math/wide.h"

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
  Vec3f position;         // m, from the island's origin
  float mass = 0;         // m / dt^2, kg/s2
  float inertia[6] = {};  // I / dt^2, world axes: xx yx yy zx zy zz
  Vec3f dFree, thFree;
};
static_assert(sizeof(SolveMass) == 64);

struct alignas(16) Wrench {
  Vec3f force;
  float pad0 = 0;
  Vec3f torque;
  float pad1 = 0;

  Wrench() = default;
  Wrench(Vec3f f, Vec3f t) : force(f), torque(t) {}
};
static_assert(sizeof(Wrench) == 32);

// Of forces along a motion.
inline float power(const Wrench& a, const Wrench& b) { return dot(a.force, b.force) + dot(a.torque, b.torque); }

// A symmetric 3 x 3 matrix by its lower triangle, times a vector in three lanes.
inline wide::V timesSymmetric(const float* m, wide::V v) {
  wide::V low = wide::loadAnywhere(m), high = wide::loadAnywhere(m + 2);  // xx yx yy zx, yy zx zy zz
  wide::V x = __builtin_shufflevector(low, low, 0, 1, 3, 3), y = __builtin_shufflevector(low, high, 1, 2, 6, 6),
          z = __builtin_shufflevector(high, high, 1, 2, 3, 3);
  return x * wide::spread<0>(v) + y * wide::spread<1>(v) + z * wide::spread<2>(v);
}

// Inertia's part of a body's residual: M (dFree - d) / dt^2, I (thFree - th) / dt^2.
inline Wrench inertiaResidual(const SolveMass& m, const SolveMotion& motion) {
  Vec3f e = m.dFree - motion.d, t = m.thFree - motion.th;
  return {e * m.mass, wide::store3(timesSymmetric(m.inertia, wide::load3(t)))};
}

}  // namespace brickfall
