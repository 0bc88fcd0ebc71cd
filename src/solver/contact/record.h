// One contact as the multilevel solve reads it: 192 bytes, made once per step. Nothing in it changes during a cycle but
// the friction limit of new points. Points are stored field by field, four lanes.
//
// All motion is relative to the manifold's own frame (normal n, tangents t1 and t2 = n x t1) at its centre:
#pragma once
#include <cstdint>

#include "math/float3.h"

namespace brickfall {

struct alignas(64) ContactRecord {
  Vec3f n, t1;                         // unit, world; n from A to B
  Vec3f armA, armB;                    // m, from the centres of mass to the manifold's centre
  std::uint32_t bodyA = 0, bodyB = 0;  // in Island::motion
  float near = 0;                      // m: open points nearer than this stay in the Newton matrix
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
