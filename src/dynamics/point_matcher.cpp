#include "dynamics/point_matcher.h"

namespace brickfall {

PointMatcher::PointMatcher(const Contact& old, const ContactGeometry& geometry, const Contact& fresh,
                           const ContactGeometry& now)
    : old_(old), geometry_(geometry), normals_(dot(geometry.normal, now.normal)), rolls_(fresh.rolls) {
  Vec3 t2 = cross(geometry.normal, geometry.tangent1), u2 = cross(now.normal, now.tangent1);
  turn_ = {{float(dot(geometry.tangent1, now.tangent1)), float(dot(t2, now.tangent1)),
            float(dot(geometry.tangent1, u2)), float(dot(t2, u2))}};
}

int PointMatcher::match(Vec3 anchorB, std::uint32_t feature) {
  if (normals_ < kSameFace) return -1;
  int best = -1;
  double bestDistance = rolls_ ? 1e30 : kMatchDistance * kMatchDistance;
  for (int j = 0; j < old_.count; j++) {
    if (used_ >> j & 1) continue;
    double distance = lengthSquared(geometry_.anchorB[j] - anchorB) * (old_.points.feature[j] == feature ? 0.25 : 1);
    if (distance < bestDistance) {
      bestDistance = distance;
      best = j;
    }
  }
  if (best >= 0) used_ |= 1u << best;
  return best;
}

}  // namespace brickfall
