// Where two edges cross, one may lie along a face beside the other: a brick on the edge of a floor. Then the shapes
// touch along a stretch, of which the crossing is one end. The crossing alone would let the brick rock from end to end,
// and sink in a little at each.
#pragma once
#include <cstdint>

#include "narrowphase/manifold.h"

namespace brickfall {

// One way along an edge from a crossing, over a face of the other shape.
struct EdgeStretch {
  Vec3 direction;        // unit
  double toEnd = 0;      // m: to the corner in which the edge ends
  Vec3 face;             // unit normal, outward
  double toSide = 0;     // m: to the side of that face
  std::uint32_t corner;  // name of the point in which the edge ends
  std::uint32_t side;    // name of the point in which the edge crosses the side of the face
};

// Adds the end of the stretch to a manifold that begins with a crossing and has its normal, if the shapes are there no
// further apart than `margin` (m). `edgeOfB`: the edge is one of B, the face one of A. `same`, m: a shorter stretch is
// a point.
void addStretch(const EdgeStretch& stretch, bool edgeOfB, double margin, double same, Manifold& out);

}  // namespace brickfall
