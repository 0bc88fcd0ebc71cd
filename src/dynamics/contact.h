// A contact: two shapes that are near, and what their points remember from step to step (point_memory.h).
//
// Gaps and drifts are never taken from world coordinates while a contact lasts (float noise would be a sizeable part of a
// brick's weight): they are found once, in double, when the manifold is made, and then carried on by the displacements
// that the solver itself computed.
#pragma once
#include <cmath>
#include <cstdint>

#include "dynamics/body_set.h"
#include "dynamics/point_memory.h"
#include "narrowphase/manifold.h"

namespace brickfall {

using ContactIndex = std::uint32_t;

struct Contact {
  ShapeIndex shapeA = kNoIndex, shapeB = kNoIndex;  // shapeA < shapeB
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  std::int32_t count = 0;  // points
  bool rolls = false;      // a sphere or capsule takes part: points wander, the manifold is never reused
  bool partial = false;    // its points are four of more
  bool touching = false;   // carried force in the last step
  bool struck = false;     // pressed in an impact of the last step that was over within it
  bool fresh = true;       // geometry changed since the solver's record was made
  bool born = true;        // made since islands were built
  bool edited = false;     // the program changed the next two for this step
  float friction = 0, restitution = 0;
  float rolling = 0;        // coefficient of rolling resistance; 0: none, or nothing round is on its side
  float rollingRadius = 0;  // m, of the curvature by which the two surfaces part
  bool crushed = false;     // a blow has crushed what it hit: the next press on the same place
  float crushing = 0;       // N, 4 pi x radius x hardness: pressing with F crushes F^2 / this; 0: nothing is round
  float effectiveMass = 0;  // kg, 1 / (1/mA + 1/mB)
  float earlierForce = 0;   // N: of its points together, in the step before; only where there is mortar, not kept
  PointMemory points;

  // Point i holds on to one place of each body. What slides or rolls is held anew where it touches, by the force that it has.
  bool keepsAnchor(int i) const { return !rolls && points.sticks(i); }
};

// What is read only when the geometry is made anew.
// Lane of PointMemory in which a contact that resists rolling keeps the force of that, where no point needs it.
//! not of the method: a place
constexpr int kRollingLane = 3;
inline bool resistsRolling(const Contact& c) {
  return c.rolls && c.rolling > 0 && c.rollingRadius > 0 && c.count <= kRollingLane;
}

// N: of all its points together.
inline float forceOf(const Contact& c) {
  float n = 0, t1 = 0, t2 = 0;
  for (int i = 0; i < c.count; i++) n += c.points.forceN[i], t1 += c.points.force1[i], t2 += c.points.force2[i];
  return std::sqrt(n * n + t1 * t1 + t2 * t2);
}

struct ContactGeometry {
  Vec3 relativePosition;  // pose of B's centre frame in A's when the manifold was made
  Quat relativeRotation;
  Vec3 normal, tangent1;        // unit, A's axes
  Vec3 centre;                  // m, mean of the points, A's centre frame
  Vec3 anchorA[4], anchorB[4];  // m, centre frames of the bodies
};

}  // namespace brickfall
