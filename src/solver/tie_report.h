// What rows of any kind tell of a step, besides their forces.
#pragma once
#include <cstdint>

#include "brickfall/math.h"
#include "dynamics/body_set.h"

namespace brickfall {

// An impulse that stopped a tie's bodies.
struct TieImpact {
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  Vec3 point, normal;  // m, world; unit, from A to B
  double speed = 0;    // m/s, the fastest approach of its points
  double impulse = 0;  // N s; after an impact at its moment: rebound left out
  ShapeIndex shapeA = kNoIndex, shapeB = kNoIndex;
};

// By the solved motion of an island, between forces and new poses.
struct TieWork {
  double work = 0;     // J, done on the bodies and on kinematic partners
  double rebound = 0;  // J, done by the forces that rebounds add: not part of `work`
  double elastic = 0;  // J, elastic energy after it
  // J, spent on breaking ties, by mode: part of `work` and `elastic`
  double pull = 0, shear = 0, crush = 0;
};

struct PointCount {
  std::int32_t all = 0, touching = 0;
};

}  // namespace brickfall
