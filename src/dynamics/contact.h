// A contact: two shapes that are near, and what their points remember from step to step. Up to four points, one lane each,
// field by field, so that a point's arithmetic is one vector operation for all four.
//
// Gaps and drifts are never taken from world coordinates while a contact lasts (float noise would be a sizeable part of a
// brick's weight): they are found once, in double, when the manifold is made, and then carried on by the displacements
// that the solver itself computed.
#pragma once
#include <cstdint>

#include "dynamics/body_set.h"
#include "narrowphase/manifold.h"

namespace brickfall {

using ContactIndex = std::uint32_t;

struct Contact {
  ShapeIndex shapeA = kNoIndex, shapeB = kNoIndex;  // shapeA < shapeB
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  std::int32_t count = 0;          // points
  std::uint32_t stickingMask = 0;  // bit per point: held by its anchor
  bool rolls = false;              // a sphere or capsule takes part: points wander, the manifold is never reused
  bool weak = true;                // a joint of a mechanism: cannot carry a moment (few loaded points, or all sliding)
  bool touching = false;           // carried force in the last step
  bool fresh = true;               // geometry changed since the solver's record was made
  bool born = true;                // made since islands were built
  std::int32_t weakSteps = 0;      // steps that weak is still held
  float friction = 0, restitution = 0;
  float effectiveMass = 0;  // kg, 1 / (1/mA + 1/mB)

  float s1[4] = {}, s2[4] = {};                          // m, place in the tangent plane, about the manifold's centre
  float gap[4] = {};                                     // m, geometric normal gap; negative = overlap
  float offset[4] = {};                                  // m, <= 0: overlap that causes no force (plastic)
  float drift1[4] = {}, drift2[4] = {};                  // m, tangential way since the anchor was placed
  float stiffness[4] = {};                               // N/m, normal and tangential; 0 = the point is new
  float heldN[4] = {}, held1[4] = {}, held2[4] = {};     // N, multiplier of the augmented Lagrangian
  float forceN[4] = {}, force1[4] = {}, force2[4] = {};  // N, applied in the last step
  float slip1[4] = {}, slip2[4] = {};                    // m, where to place the anchor of a point that slid
  std::uint32_t feature[4] = {};
};

// What is read only when the geometry is made anew.
struct ContactGeometry {
  Vec3 relativePosition;  // pose of B's centre frame in A's when the manifold was made
  Quat relativeRotation;
  Vec3 normal, tangent1;        // unit, A's axes
  Vec3 centre;                  // m, mean of the points, A's centre frame
  Vec3 anchorA[4], anchorB[4];  // m, centre frames of the bodies
};

}  // namespace brickfall
