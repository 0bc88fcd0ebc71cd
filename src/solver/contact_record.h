// One contact as the multilevel solve reads it: 192 bytes, made once per step, nothing in it changes during a cycle but
// the friction limit of new points. Points field by field, four lanes.
//
// All motion is relative to the manifold's own frame (normal n, tangents t1 and t2 = n x t1) at its centre:
//   u = relative displacement at the centre, w = relative turn, both of B against A, along (n, t1, t2);
//   a point at (s1, s2) moves by  Cn = un + w1 s2 - w2 s1,  C1 = u1 - wn s2,  C2 = u2 + wn s1.
// One point serves both bodies (the middle of the two surface points), so action and reaction have one line and angular
// momentum is kept exactly.
#pragma once
#include <cstdint>

#include "math/float3.h"

namespace brickfall {

struct alignas(64) ContactRecord {
  Vec3f n, t1;                         // unit, world; n from A to B
  Vec3f armA, armB;                    // m, from the centres of mass to the manifold's centre
  std::uint32_t bodyA = 0, bodyB = 0;  // in Island::motion
  std::uint32_t contact = 0;           // ContactIndex
  std::uint32_t newPoints = 0;         // bit per point that carried nothing in the last step

  float s1[4] = {}, s2[4] = {};  // m
  float trialN[4] = {};          // N, force at zero motion: held share - k (correctable gap)
  float trial1[4] = {}, trial2[4] = {};
  float k[4] = {};      // N/m; 0 in unused lanes
  float limit[4] = {};  // N, friction cone
  float bond[4] = {};   // N, tension carried; 0 = dry
};
static_assert(sizeof(ContactRecord) == 192);

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

}  // namespace brickfall
