// Closest points of a triangle and a point, and of two triangles. The closest points of two triangles that are apart lie on
// two edges, or on a corner and a face: all fifteen cases are looked at, unless one proves itself: the slab between the two
// points, across the line through them, has one triangle on either side.
#include "brickfall/geometry/triangle_mesh.h"

namespace brickfall {

namespace {

double clamped01(double t) { return t < 0 ? 0 : t > 1 ? 1 : t; }

struct Nearest {
  double squared = 1e300;
  Vec3 onA, onB;

  void take(Vec3 a, Vec3 b) {
    double d = lengthSquared(b - a);
    if (d < squared) squared = d, onA = a, onB = b;
  }
};

// Closest points of the segments p + s d and q + t e, s and t in 0..1.
void nearestOfEdges(Vec3 p, Vec3 d, Vec3 q, Vec3 e, Vec3& onD, Vec3& onE) {
  Vec3 r = p - q;
  double dd = lengthSquared(d), ee = lengthSquared(e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
  double denominator = dd * ee - de * de;
  double s = denominator > 0 ? clamped01((de * er - dr * ee) / denominator) : 0;
  double t = (de * s + er) / ee;
  if (!(t >= 0 && t <= 1)) {
    t = clamped01(t);
    s = clamped01((de * t - dr) / dd);
  }
  onD = p + d * s;
  onE = q + e * t;
}

// Where an edge of one passes through the other.
bool edgeThrough(const Triangle& t, Vec3 from, Vec3 to, Vec3& at) {
  Vec3 n = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
  double h0 = dot(n, from - t.corner[0]), h1 = dot(n, to - t.corner[0]);
  if ((h0 > 0 && h1 > 0) || (h0 < 0 && h1 < 0) || h0 == h1) return false;
  Vec3 p = from + (to - from) * (h0 / (h0 - h1));
  for (int k = 0; k < 3; k++)
    if (dot(cross(n, t.corner[(k + 1) % 3] - t.corner[k]), p - t.corner[k]) < 0) return false;
  at = p;
  return true;
}

bool commonPoint(const Triangle& a, const Triangle& b, Vec3& at) {
  for (int k = 0; k < 3; k++)
    if (edgeThrough(a, b.corner[k], b.corner[(k + 1) % 3], at) ||
        edgeThrough(b, a.corner[k], a.corner[(k + 1) % 3], at))
      return true;
  return false;
}

}  // namespace

TrianglePoint closestPoint(const Triangle& triangle, Vec3 point) {
  const Vec3* c = triangle.corner;
  Vec3 e[3] = {c[1] - c[0], c[2] - c[1], c[0] - c[2]};
  Vec3 n = cross(e[0], e[1]);
  bool inside = true;
  TrianglePoint best;
  double nearest = 1e300;
  for (int k = 0; k < 3; k++) {
    Vec3 r = point - c[k];
    if (dot(cross(n, e[k]), r) >= 0) continue;
    inside = false;
    double t = dot(r, e[k]) / lengthSquared(e[k]);
    TrianglePoint candidate;
    if (t <= 0) {
      candidate = {c[k], TrianglePart::corner, k};
    } else if (t >= 1) {
      candidate = {c[(k + 1) % 3], TrianglePart::corner, (k + 1) % 3};
    } else {
      candidate = {c[k] + e[k] * t, TrianglePart::edge, k};
    }
    double distance = lengthSquared(point - candidate.point);
    if (distance < nearest) nearest = distance, best = candidate;
  }
  if (inside) best = {point - n * (dot(n, point - c[0]) / lengthSquared(n)), TrianglePart::face, 0};
  return best;
}

TriangleDistance triangleDistance(const Triangle& a, const Triangle& b) {
  Nearest best;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      Vec3 p = a.corner[i], q = b.corner[j], onA, onB;
      nearestOfEdges(p, a.corner[(i + 1) % 3] - p, q, b.corner[(j + 1) % 3] - q, onA, onB);
      Vec3 apart = onB - onA;
      double squared = lengthSquared(apart);
      if (!(squared < best.squared)) continue;
      best.squared = squared, best.onA = onA, best.onB = onB;
      bool slab = dot(apart, a.corner[(i + 2) % 3] - onA) <= 0 && dot(apart, b.corner[(j + 2) % 3] - onB) >= 0;
      if (slab && squared > 0) return {std::sqrt(squared), onA, onB};
    }
  for (int k = 0; k < 3; k++) {
    best.take(closestPoint(a, b.corner[k]).point, b.corner[k]);
    best.take(a.corner[k], closestPoint(b, a.corner[k]).point);
  }
  Vec3 apart = best.onB - best.onA;
  bool slab = best.squared > 0;
  for (int k = 0; k < 3 && slab; k++)
    slab = dot(apart, a.corner[k] - best.onA) <= 0 && dot(apart, b.corner[k] - best.onB) >= 0;
  if (slab) return {std::sqrt(best.squared), best.onA, best.onB};
  Vec3 common;
  if (commonPoint(a, b, common)) return {0, common, common};
  if (trianglesOverlap(a, b)) return {0, best.onA, best.onA};
  return {std::sqrt(best.squared), best.onA, best.onB};
}

}  // namespace brickfall
