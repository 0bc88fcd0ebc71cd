#include "narrowphase/edge_stretch.h"

#include <algorithm>

namespace brickfall {

namespace {

// Sine of the angle between an edge and a face: an edge that rises more only crosses the edge of the face.
constexpr double kAlongFace = 0.25;

}  // namespace

void addStretch(const EdgeStretch& stretch, bool edgeOfB, double margin, double same, Manifold& out) {
  const double reach = std::min(stretch.toEnd, stretch.toSide);
  if (out.count == kMaxManifoldPoints || !(reach > same)) return;
  const Vec3 n = out.normal;
  const double up = dot(stretch.face, edgeOfB ? n : -n), falls = std::max(0.0, dot(stretch.face, stretch.direction));
  const ManifoldPoint& crossing = out.points[0];
  if (!(up > 0) || falls > kAlongFace || reach * falls > (margin - crossing.separation) * up) return;
  const double separation = crossing.separation + reach * falls / up;
  const Vec3 end = (edgeOfB ? crossing.onB : crossing.onA) + stretch.direction * reach;
  const std::uint32_t name = stretch.toEnd < stretch.toSide ? stretch.corner : stretch.side;
  out.points[out.count++] = edgeOfB ? ManifoldPoint{end - n * separation, end, separation, name}
                                    : ManifoldPoint{end, end + n * separation, separation, name};
}

}  // namespace brickfall
