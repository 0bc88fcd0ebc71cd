// A face between two bodies as the solve reads it: up to four points, each with a normal law and friction. 192 bytes,
// made once per step by the kind of tie that the face belongs to: a contact, mortar. Nothing in it changes during a
// cycle but what that kind lets follow the solve (the friction limit of new points). Points are stored field by field,
// four lanes. What a point stands for (its area, its strength) is in its stiffness, its limit and its least force.
//
// All motion is relative to the face's own frame (normal n, tangents t1 and t2 = n x t1) at its centre.
#pragma once
#include <cstdint>

#include "math/float3.h"

namespace brickfall {

struct alignas(64) FaceRecord {
  Vec3f n, t1;                         // unit, world; n from A to B
  Vec3f armA, armB;                    // m, from the centres of mass to the face's centre
  std::uint32_t bodyA = 0, bodyB = 0;  // in Island::motion
  // m: open points nearer than this stay in the Newton matrix. Below 0: no such points, and none bears more than -near,
  // N, until it has gone `yields` / kYieldParts of the way that this force makes. Then what was crushed lies firm.
  float near = 0;
  union {
    std::uint16_t newPoints = 0;  // bit per point whose friction limit follows: it carried nothing, or an impact
    std::uint16_t yields;         // of faces that crush
  };
  // 1: the last lane is no point. It resists rolling: its way is the turn of B against A about t1 and t2 times s1, a
  // radius, and its friction is a torque over that radius.
  std::uint16_t rolls = 0;

  float s1[4] = {}, s2[4] = {};  // m
  float trialN[4] = {};          // N, force at zero motion: share of the multiplier - k (correctable gap)
  float trial1[4] = {}, trial2[4] = {};
  float k[4] = {};       // N/m; 0 in unused lanes
  float limit[4] = {};   // N, friction cone
  float leastN[4] = {};  // N, least normal force: below 0 of a bonded point, above 0 of one that rebounds
};
static_assert(sizeof(FaceRecord) == 192);

// Along the normal and the two tangents.
inline Vec3f inFace(const FaceRecord& r, Vec3f v) { return {dot(r.n, v), dot(r.t1, v), dot(cross(r.n, r.t1), v)}; }

//! not of the method: parts of a way that a number of 16 bits counts
inline constexpr float kYieldParts = 64;
// N, of a point: the most that it bears while it crushes; how much more a firm spring would bear until it is crushed.
inline float mostOf(const FaceRecord& r) { return r.near < 0 ? -r.near : 3e38f; }
inline float yieldOf(const FaceRecord& r) { return r.near < 0 ? -r.near * (float(r.yields) / kYieldParts) : 0.0f; }

}  // namespace brickfall
