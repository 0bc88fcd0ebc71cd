// What all face contacts share: from a polygon of candidate points to at most four.
#pragma once
#include <cstdint>

#include "brickfall/math.h"
#include "brickfall/shapes.h"
#include "narrowphase/manifold.h"

namespace brickfall {

// A corner of the contact polygon: u, v in the plane of the reference face, separation above it.
struct PatchPoint {
  double u = 0, v = 0;
  double separation = 0;
  std::uint32_t feature = 0;
};

// Lengths below which geometry counts as equal, m: in proportion to the smaller of the two.
struct ContactTolerances {
  double face;       // a later face axis must be better by this
  double otherFace;  // ... and by this if the two are nearly parallel: then either is right, and one should stay
  double edge;       // an edge axis must beat the faces by this: it gives only one point
  double slack;      // aligned bricks: a corner outside by this much is not cut off
  double same;       // polygon corners closer than this are one
};
inline ContactTolerances contactTolerances(double smallestHalfExtent) {
  const double h = smallestHalfExtent * 30;
  return {1e-5 * h, 5e-4 * h, 1e-3 * h, 2e-5 * h, 1e-4 * h};
}

constexpr int kMaxPatchPoints = 2 * kMaxHullVertices;  // corners of two faces

struct ReducedPatch {
  int count = 0;
  bool partial = false;  // some corners were left out
};

// Merges equal corners (the loaded one stays; of two alike in that the deeper). Of more than four it keeps those that are
// loaded, the deepest, and those that add most to the area of these, one by one. Keeps the order around the convex polygon.
ReducedPatch reducePatch(PatchPoint* points, int count, const ContactTolerances& tolerances,
                         const LoadedPoints& loaded);

}  // namespace brickfall
