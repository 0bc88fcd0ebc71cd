// Two triangles share a point unless an axis separates them: a normal, a cross product of two edges, or, where these vanish
// (one plane, parallel edges), the normal of an edge in the plane of its triangle.
//
// An axis is taken as computed: however wrong it may be (edges nearly parallel), a gap along it that is larger than the
// rounding of the projections is proof. So there is nothing to decide about directions, and a false "apart" can't happen;
// what rounding hides counts as touching.
#include "brickfall/geometry/triangle_mesh.h"

namespace brickfall {

namespace {

constexpr double kTolerance = 1e-13;  // of the size of the pair

double largest(Vec3 v) {
  Vec3 a = abs(v);
  double xy = a.x > a.y ? a.x : a.y;
  return xy > a.z ? xy : a.z;
}
double smaller(double a, double b) { return a < b ? a : b; }
double larger(double a, double b) { return a > b ? a : b; }

// Corners relative to the first corner of a.
struct Pair {
  Vec3 p1, p2, q0, q1, q2;  // p0 is the origin
  double slack;             // per unit of axis (sum of its absolute components)

  // Whether a gap lies between [aLow, aHigh] and [bLow, bHigh], projections on `axis`.
  bool gap(Vec3 axis, double aLow, double aHigh, double bLow, double bHigh) const {
    double least = slack * (std::fabs(axis.x) + std::fabs(axis.y) + std::fabs(axis.z));
    return bLow - aHigh > least || aLow - bHigh > least;
  }
  bool separates(Vec3 axis) const {
    double a1 = dot(axis, p1), a2 = dot(axis, p2), b0 = dot(axis, q0), b1 = dot(axis, q1), b2 = dot(axis, q2);
    return gap(axis, smaller(0, smaller(a1, a2)), larger(0, larger(a1, a2)), smaller(b0, smaller(b1, b2)),
               larger(b0, larger(b1, b2)));
  }
};

}  // namespace

bool trianglesOverlap(const Triangle& a, const Triangle& b) {
  Vec3 origin = a.corner[0];
  Pair pair{a.corner[1] - origin, a.corner[2] - origin, b.corner[0] - origin,
            b.corner[1] - origin, b.corner[2] - origin, 0};
  Vec3 size = max(max(abs(pair.p1), abs(pair.p2)), max(max(abs(pair.q0), abs(pair.q1)), abs(pair.q2)));
  pair.slack = kTolerance * largest(size);

  Vec3 e[3] = {pair.p1, pair.p2 - pair.p1, -pair.p2};
  Vec3 normalA = cross(pair.p1, pair.p2);
  double b0 = dot(normalA, pair.q0), b1 = dot(normalA, pair.q1), b2 = dot(normalA, pair.q2);
  if (pair.gap(normalA, 0, 0, smaller(b0, smaller(b1, b2)), larger(b0, larger(b1, b2)))) return false;
  Vec3 f[3] = {pair.q1 - pair.q0, pair.q2 - pair.q1, pair.q0 - pair.q2};
  Vec3 normalB = cross(f[0], f[1]);
  double level = dot(normalB, pair.q0), a1 = dot(normalB, pair.p1), a2 = dot(normalB, pair.p2);
  if (pair.gap(normalB, smaller(0, smaller(a1, a2)), larger(0, larger(a1, a2)), level, level)) return false;
  for (Vec3 edgeA : e)
    for (Vec3 edgeB : f)
      if (pair.separates(cross(edgeA, edgeB))) return false;
  for (Vec3 edgeA : e)
    if (pair.separates(cross(edgeA, normalA))) return false;
  for (Vec3 edgeB : f)
    if (pair.separates(cross(edgeB, normalB))) return false;
  return true;
}

}  // namespace brickfall
