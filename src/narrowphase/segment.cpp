#include "narrowphase/segment.h"

#include <algorithm>

namespace brickfall {

SegmentPair nearestOfSegments(Vec3 p0, Vec3 d, Vec3 q0, Vec3 e) {
  double dd = dot(d, d), ee = dot(e, e), de = dot(d, e);
  Vec3 r = q0 - p0;
  double dr = dot(d, r), er = dot(e, r);
  // sin^2 of the angle, from the cross product: exact however small.
  double cross2 = lengthSquared(cross(d, e));
  SegmentPair out;
  if (cross2 > 1e-16 * dd * ee) {
    out.s = std::clamp(dot(cross(r, e), cross(d, e)) / cross2, 0.0, 1.0);
  } else if (dd > 0) {
    double a = std::clamp(dr / dd, 0.0, 1.0), b = std::clamp((dr + de) / dd, 0.0, 1.0);
    out.s = 0.5 * (a + b);
  }
  // For a given s the best t is the foot; if that is cut off, the best s for the end of e.
  double t = ee > 0 ? (de * out.s - er) / ee : 0;
  out.t = std::clamp(t, 0.0, 1.0);
  if (out.t != t && dd > 0) out.s = std::clamp((de * out.t + dr) / dd, 0.0, 1.0);
  out.p = p0 + d * out.s;
  out.q = q0 + e * out.t;
  return out;
}

}  // namespace brickfall
