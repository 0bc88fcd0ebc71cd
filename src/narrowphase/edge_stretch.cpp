#include "narrowphase/edge_stretch.h"

#include <algorithm>

namespace brickfall {

void addStretch(const EdgeStretch& stretch, bool edgeOfB, double margin, double same, Manifold& out) {
  const double reach = std::min(stretch.toEnd, stretch.toSide);
  if (out.count == kMaxManifoldPoints || !(reach > same)) return;
  const Vec3 n = out.normal;
  const double up = dot(stretch.face, edgeOfB ? n : -n), falls = std::max(0.0, dot(stretch.face, stretch.direction));
  // Cut short where the face falls away by more than the margin: up is not divided by, it may be 0.
  const ManifoldPoint& crossing = out.points[0];
  if (!(up > 0) || reach * falls > (margin - crossing.separation) * up) return;
  const double separation = crossing.separation + reach * falls / up;
  const Vec3 end = (edgeOfB ? crossing.onB : crossing.onA) + stretch.direction * reach;
  const std::uint32_t name = stretch.toEnd < stretch.toSide ? stretch.corner : stretch.side;
  out.points[out.count++] = edgeOfB ? ManifoldPoint{end - n * separation, end, separation, name}
                                    : ManifoldPoint{end, end + n * separation, separation, name};
}

}  // namespace brickfall
