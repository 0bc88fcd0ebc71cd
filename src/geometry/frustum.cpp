#include "geometry/frustum.h"

#include <cmath>

namespace brickfall {

namespace {

// The half plane through the axis and a point: how far from the axis, how high.
struct Meridian {
  double out = 0, up = 0;
};

struct MeridianFoot {
  Meridian at, normal;
  double distance = 1e300;
};

// Distance from the line of a side, and with it the foot on it.
MeridianFoot onSide(Meridian p, Meridian start, Meridian end, Meridian normal) {
  const Meridian along{end.out - start.out, end.up - start.up};
  const double squared = along.out * along.out + along.up * along.up;
  double t = ((p.out - start.out) * along.out + (p.up - start.up) * along.up) / squared;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  MeridianFoot foot;
  foot.at = {start.out + along.out * t, start.up + along.up * t};
  foot.normal = normal;
  const double out = p.out - foot.at.out, up = p.up - foot.at.up;
  foot.distance = std::sqrt(out * out + up * up);
  return foot;
}

}  // namespace

void Frustum::sideNormal(double& out, double& up) const {
  const double rise = 2 * half, inward = low - high, length = std::sqrt(rise * rise + inward * inward);
  out = rise / length;
  up = inward / length;
}

Vec3 Frustum::furthest(Vec3 direction) const {
  const double across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  const int end = high * across + half * direction.y > low * across - half * direction.y ? 1 : 0;
  const double scale = across > 0 ? radius(end) / across : 0;
  return {direction.x * scale, height(end), direction.z * scale};
}

double Frustum::centre() const {
  const double squares = low * low + low * high + high * high;
  return half * ((low * low + 2 * low * high + 3 * high * high) / (2 * squares) - 1);
}

FrustumFoot footOn(const Frustum& f, Vec3 point) {
  const double out = std::sqrt(point.x * point.x + point.z * point.z);
  const Vec3 away = out > 0 ? Vec3{point.x / out, 0, point.z / out} : Vec3{1, 0, 0};
  const Meridian p{out, point.y}, lowRim{f.low, -f.half}, highRim{f.high, f.half};
  Meridian slope;
  f.sideNormal(slope.out, slope.up);
  const double aboveSide = (p.out - lowRim.out) * slope.out + (p.up - lowRim.up) * slope.up;
  const bool inside = p.up <= f.half && p.up >= -f.half && aboveSide <= 0;
  MeridianFoot best;
  auto offer = [&](const MeridianFoot& foot) {
    if (foot.distance < best.distance) best = foot;
  };
  offer(onSide(p, lowRim, highRim, slope));
  if (f.high > 0) offer(onSide(p, {0, f.half}, highRim, {0, 1}));
  if (f.low > 0) offer(onSide(p, {0, -f.half}, lowRim, {0, -1}));
  if (!inside && best.distance > 0)
    best.normal = {(p.out - best.at.out) / best.distance, (p.up - best.at.up) / best.distance};
  return {away * best.at.out + Vec3{0, best.at.up, 0}, away * best.normal.out + Vec3{0, best.normal.up, 0},
          inside ? -best.distance : best.distance};
}

}  // namespace brickfall
