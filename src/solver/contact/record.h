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
  float near = 0;                      // m: an open point that is nearer stays in the Newton matrix
  std::uint32_t newPoints = 0;         // bit per point whose friction limit follows: it carried nothing, or an impact

  float s1[4] = {}, s2[4] = {};  // m
  float trialN[4] = {};          // N, force at zero motion: share of the multiplier - k (correctable gap)
  float trial1[4] = {}, trial2[4] = {};
  float k[4] = {};           // N/m; 0 in unused lanes
  float limit[4] = {};       // N, friction cone
  float tensionCap[4] = {};  // N, tension carried; 0 = dry; negative = the pressure of a rebound, at least
};
static_assert(sizeof(ContactRecord) == 192);

}  // namespace brickfall
