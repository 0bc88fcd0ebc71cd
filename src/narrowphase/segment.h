// Nearest points of segments: the cores of capsules, the edges of hulls.
#pragma once
#include "brickfall/math.h"

namespace brickfall {

struct SegmentPair {
  double s = 0, t = 0;  // 0..1 along each
  Vec3 p, q;            // the points
};

// Nearest points of p0 + s d and q0 + t e. Of the many of parallel segments, the middle of the common stretch.
SegmentPair nearestOfSegments(Vec3 p0, Vec3 d, Vec3 q0, Vec3 e);

}  // namespace brickfall
