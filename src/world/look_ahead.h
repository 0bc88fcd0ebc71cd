// What shapes that are apart will meet in a step. The points and the normal of a contact are frozen for a step; taken where it begins,
// they can make a wall of what only lies beside a fast body's way: a ball that flies past an edge would bounce off it, a box that slides
// over flush bricks would stop at the side of the next one. So they are taken from where the shapes meet.
#pragma once
#include "dynamics/shape_set.h"
#include "narrowphase/manifold.h"

namespace brickfall {

// Two bodies at the start of a step, in A's centre frame.
struct RelativeMotion {
  Transform pose;     // B's centre frame
  Vec3 velocity;      // m/s, of B's centre against A's
  Vec3 spinA, spinB;  // rad/s
};

// Of the manifold `m` of two shapes as they are now, for the coming dt: where they meet only later, the points and the normal with
// which they do (round shapes), as they lie now; no points where they pass each other at more than `margin` (m), or where one's edge
// slides over the other's face. Convex shapes; `reach` (m): of the manifold. True if anything was changed.
bool lookAhead(const ShapeData& a, const ShapeData& b, const RelativeMotion& motion, double dt, double reach,
               double margin, Manifold& m);

}  // namespace brickfall
