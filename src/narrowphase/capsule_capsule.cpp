// Capsules side by side touch along a line: two points, the ends of the stretch where they run beside each other.
// Otherwise one. Side by side means that over this stretch the axes part sideways by so little of the radius that the
// round surfaces still face each other along the one normal.
#include <algorithm>

#include "narrowphase/features.h"
#include "narrowphase/pairs.h"
#include "narrowphase/segment.h"

namespace brickfall {
namespace {

constexpr double kBeside = 0.1;  // of the smaller radius
constexpr double kLoss = 0.005;  // of the smaller radius: what the common normal may be off in depth or from a surface

}  // namespace

void collideCapsuleCapsule(const Shape& a, const Shape& b, const Transform& bInA, double margin, Manifold& out) {
  Vec3 axis = rotate(bInA.rotation, Vec3{0, 1, 0}), d{0, 2 * a.halfHeight, 0};
  Vec3 p0{0, -a.halfHeight, 0}, q0 = bInA.position - axis * b.halfHeight;
  SegmentPair nearest = nearestOfSegments(p0, d, q0, axis * (2 * b.halfHeight));
  Vec3 between = nearest.q - nearest.p;
  double distance = length(between), radii = a.radius + b.radius;
  if (!(distance - radii <= margin)) return;

  Vec3 n;
  if (distance > 1e-9 * radii) {
    n = between * (1 / distance);
  } else {  // the axes cross: out across both
    n = normalized(cross(Vec3{0, 1, 0}, axis));
    if (lengthSquared(n) < 0.5) n = {1, 0, 0};
  }

  // The ends of b's axis seen along a's, cut to a's.
  double low = q0.y, high = q0.y + 2 * b.halfHeight * axis.y;
  double from = std::max(std::min(low, high), -a.halfHeight), to = std::min(std::max(low, high), a.halfHeight);
  double sine = length(cross(Vec3{0, 1, 0}, axis)), smaller = std::min(a.radius, b.radius);
  bool beside =
      std::fabs(n.y) < kBeside && to - from > kBeside * smaller && 0.5 * (to - from) * sine < kBeside * smaller;
  if (beside) {
    Vec3 common = normalized(Vec3{n.x, 0, n.z});  // across a's axis, so that the points on a are on a plane
    double nearer = 1e30, alongB = dot(common, axis);
    for (int end = 0; end < 2; end++) {
      double y = end == 0 ? from : to;
      Vec3 p{0, y, 0}, q = q0 + axis * ((y - q0.y) / axis.y);
      double separation = dot(common, q - p) - radii;
      nearer = std::min(nearer, separation);
      if (separation > margin) continue;
      Vec3 onA = p + common * a.radius;
      out.points[out.count++] = {onA, onA + common * separation, separation, roundPoint(end)};
    }
    out.normal = common;
    // Next to a far larger capsule a normal turned by a few degrees shows another depth altogether.
    bool fair = std::fabs(nearer - (distance - radii)) <= kLoss * smaller &&
                0.5 * b.radius * alongB * alongB <= kLoss * smaller;
    if (fair && out.count > 0) return;
    out.count = 0;
  }
  double separation = dot(n, between) - radii;
  Vec3 onA = nearest.p + n * a.radius;
  out.normal = n;
  out.count = 1;
  out.points[0] = {onA, onA + n * separation, separation, roundPoint(2)};
}

}  // namespace brickfall
