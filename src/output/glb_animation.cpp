#include "output/glb_animation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brickfall {
namespace {

// Ramer-Douglas-Peucker over time: a stretch whose worst frame is off by more than the tolerance is cut there. `off` gives
// the error of frame f when only a and b are kept.
template <class Off> std::vector<std::uint32_t> keys(std::size_t frames, double tolerance, Off off) {
  auto last = std::uint32_t(frames - 1);
  std::vector<std::uint32_t> kept{0};
  bool moves = false;
  for (std::uint32_t f = 1; f < frames && !moves; f++) moves = off(f, 0, 0) > tolerance;
  if (!moves) return kept;
  kept.push_back(last);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0, last}};
  while (!open.empty()) {
    auto [a, b] = open.back();
    open.pop_back();
    double worst = 0;
    std::uint32_t at = a;
    for (std::uint32_t f = a + 1; f < b; f++) {
      if (double e = off(f, a, b); e > worst) worst = e, at = f;
    }
    if (!(worst > tolerance)) continue;
    kept.push_back(at);
    open.push_back({a, at});
    open.push_back({at, b});
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

double shareOf(std::span<const double> times, std::uint32_t f, std::uint32_t a, std::uint32_t b) {
  return a == b ? 0 : (times[f] - times[a]) / (times[b] - times[a]);
}

}  // namespace

double angleBetween(Quat a, Quat b) {
  Quat d = conjugate(a) * b;
  return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::fabs(d.w));
}

Quat blend(Quat a, Quat b, double share) {
  double fa = 1 - share, fb = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -share : share;
  return normalized(Quat{a.x * fa + b.x * fb, a.y * fa + b.y * fb, a.z * fa + b.z * fb, a.w * fa + b.w * fb});
}

Quat slerp(Quat a, Quat b, double share) {
  double cosine = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
  double side = cosine < 0 ? -1 : 1, angle = std::acos(std::min(1.0, std::fabs(cosine)));
  double s = std::sin(angle), fa = 1 - share, fb = share;
  if (s > 1e-6) fa = std::sin((1 - share) * angle) / s, fb = std::sin(share * angle) / s;
  fb *= side;
  return normalized(Quat{a.x * fa + b.x * fb, a.y * fa + b.y * fb, a.z * fa + b.z * fb, a.w * fa + b.w * fb});
}

std::vector<std::uint32_t> keysOfPositions(std::span<const Transform> poses, std::span<const double> times) {
  return keys(poses.size(), kGlbPositionTolerance, [&](std::uint32_t f, std::uint32_t a, std::uint32_t b) {
    Vec3 between = poses[a].position + (poses[b].position - poses[a].position) * shareOf(times, f, a, b);
    return length(poses[f].position - between);
  });
}

std::vector<std::uint32_t> keysOfRotations(std::span<const Transform> poses, std::span<const double> times) {
  return keys(poses.size(), kGlbAngleTolerance, [&](std::uint32_t f, std::uint32_t a, std::uint32_t b) {
    const Quat q = poses[f].rotation, from = poses[a].rotation, to = poses[b].rotation;
    double share = shareOf(times, f, a, b);
    return std::max(angleBetween(q, slerp(from, to, share)), angleBetween(q, blend(from, to, share)));
  });
}

}  // namespace brickfall
