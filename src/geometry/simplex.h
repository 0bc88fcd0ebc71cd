// The state of the GJK algorithm: up to four corners of the difference A - B, each with the points of A and B it is made
// of.
#pragma once
#include "brickfall/math.h"

namespace brickfall {

struct SimplexCorner {
  Vec3 onA, onB;
  Vec3 point;         // onA - onB
  double weight = 0;  // of the nearest point, which is the weighted sum of the corners
};

struct Simplex {
  SimplexCorner corner[4];
  int count = 0;
  Vec3 nearest;    // point of the simplex nearest to the origin: its error is of the size of the corners, ...
  Vec3 direction;  // ... so this is what points from the origin to it, for searching, also if it is very near; unit
  bool hasOrigin = false;

  bool has(Vec3 point) const {
    for (int k = 0; k < count; k++) {
      if (corner[k].point == point) return true;
    }
    return false;
  }
};

// Finds the nearest point and drops the corners it does not need. The last corner lies beyond the plane through the
// nearest point of the others, so the new one needs it. Flat and doubled corners are fine. `apart`: the origin is known to
// be outside, so that four corners which seem to surround it do so by rounding only.
void reduce(Simplex& simplex, bool apart = false);

}  // namespace brickfall
