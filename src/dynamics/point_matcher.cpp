#include "dynamics/point_matcher.h"

#include <algorithm>

namespace brickfall {

PointMatcher::PointMatcher(const Contact& old, const ContactGeometry& geometry, const Contact& fresh,
                           const ContactGeometry& now, double reach) {
  Vec3 t2 = cross(geometry.normal, geometry.tangent1), u2 = cross(now.normal, now.tangent1);
  turn_ = {{float(dot(geometry.tangent1, now.tangent1)), float(dot(t2, now.tangent1)),
            float(dot(geometry.tangent1, u2)), float(dot(t2, u2))}};
  const double normals = dot(geometry.normal, now.normal);
  if (normals < kSameFace) return;
  double distance[4][4];
  for (int i = 0; i < fresh.count; i++)
    for (int j = 0; j < old.count; j++) {
      bool sameFeature = old.points.feature[j] == fresh.points.feature[i];
      distance[i][j] = std::min(lengthSquared(geometry.anchorA[j] - now.anchorA[i]),
                                lengthSquared(geometry.anchorB[j] - now.anchorB[i])) *
                       (sameFeature ? 0.25 : 1);
    }
  const double most = fresh.rolls ? 1e30 : reach * reach;
  const double same = kSamePlace / kMatchShare * reach;
  std::uint32_t used = 0;  // bit per old point
  for (int n = 0; n < fresh.count; n++) {
    int to = -1, best = -1;
    double least = most;
    for (int i = 0; i < fresh.count; i++)
      for (int j = 0; j < old.count; j++)
        if (from_[i] < 0 && !(used >> j & 1) && distance[i][j] < least) least = distance[i][j], to = i, best = j;
    if (best < 0) return;
    from_[to] = best;
    used |= 1u << best;
    bool place = old.points.feature[best] == fresh.points.feature[to] || least < same * same;
    if (place && normals > kKeptFace && !fresh.rolls) keeps_ |= 1u << to;
  }
}

}  // namespace brickfall
