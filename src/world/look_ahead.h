// Which surfaces shapes that are apart will meet in a step. The points and the normal of a contact are frozen for a
// step. Taken where the step begins, they can make a wall of a surface that only lies beside a fast body's way. A ball
// that flies past an edge would bounce off it, and a box that slides over flush bricks would stop at the side of the
// next one. So they are taken from where the shapes meet.
#pragma once
#include "dynamics/shape_set.h"
#include "narrowphase/manifold.h"

namespace brickfall {

//! m | too small: cost of bodies that hardly move
//! | too large: frozen normals and arms are wrong: balls catch on edges that they pass
constexpr double kLittleWay = 1e-3;  // in a step: the surface that is nearest now is the one that is met
//! m | too small: manifolds made anew for nothing | too large: frozen normals and arms are wrong
constexpr double kHardlyMoved = 1e-4;  // a contact whose bodies have moved against each other by less is as it was

// Two bodies at the start of a step, in A's centre frame.
struct RelativeMotion {
  Transform pose;     // B's centre frame
  Vec3 velocity;      // m/s, of B's centre against A's
  Vec3 spinA, spinB;  // rad/s
};

enum class AheadFound {
  asNow,   // the surface that is nearest now
  meets,   // the manifold of a later moment
  passes,  // nothing, if both go on straight until `time`
};
struct Ahead {
  AheadFound found = AheadFound::asNow;
  // If they pass:
  double time = 0;   // s, when they are past; 0 where it does not matter what else turns them aside
  double apart = 0;  // m, by which they clear each other until then
};

// m, of two shapes.
struct LookRoom {
  double reach = 0;   // of their manifold
  double margin = 0;  // what passes at more than this passes
  double sunk = 0;    // by which a round one lies too low under its load
};

// Finds what two shapes with the manifold `m` will meet in the coming dt. For round shapes that meet later in the step,
// and for any without points that would end in each other, `m` becomes the manifold of the touch, as it lies now.
// Shapes that pass each other at more than the margin pass: `m` stays. So does a shape that slides over a face whose
// side it would have hit, and a round one that overlaps an edge by hardly more than it has sunk in where it comes from:
// both would be level under rigid contacts. Shapes are convex.
Ahead lookAhead(const ShapeData& a, const ShapeData& b, const RelativeMotion& motion, double dt, const LookRoom& room,
                Manifold& m);

}  // namespace brickfall
