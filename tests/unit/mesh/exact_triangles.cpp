// Signs of orientation determinants in 64-bit integers. Triangles that are not in one plane share a point if an edge of one
// meets the other; in one plane, if edges meet or one holds a corner of the other.
#include "exact_triangles.h"

namespace brickfall::test {

namespace {

using Whole = long long;
struct Point {
  Whole x, y, z;
};

Point minus(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point crossed(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Whole dotted(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
int sign(Whole v) { return (v > 0) - (v < 0); }
int side(const Point* t, Point p) {
  return sign(dotted(crossed(minus(t[1], t[0]), minus(t[2], t[0])), minus(p, t[0])));
}
int volume(Point a, Point b, Point c, Point d) { return sign(dotted(crossed(minus(b, a), minus(c, a)), minus(d, a))); }

struct Flat {
  Whole u, v;
};
// Drops the coordinate along which the plane's normal is longest.
Flat flat(Point p, Point n) {
  Whole x = n.x < 0 ? -n.x : n.x, y = n.y < 0 ? -n.y : n.y, z = n.z < 0 ? -n.z : n.z;
  if (x >= y && x >= z) return {p.y, p.z};
  return y >= z ? Flat{p.z, p.x} : Flat{p.x, p.y};
}
int turn(Flat a, Flat b, Flat c) { return sign((b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u)); }
bool between(Flat a, Flat b, Flat p) {
  auto within = [](Whole low, Whole high, Whole x) {
    return low < high ? low <= x && x <= high : high <= x && x <= low;
  };
  return within(a.u, b.u, p.u) && within(a.v, b.v, p.v);
}
bool segmentsMeet(Flat a, Flat b, Flat c, Flat d) {
  int t1 = turn(a, b, c), t2 = turn(a, b, d), t3 = turn(c, d, a), t4 = turn(c, d, b);
  if (t1 != t2 && t3 != t4) return true;
  return (t1 == 0 && between(a, b, c)) || (t2 == 0 && between(a, b, d)) || (t3 == 0 && between(c, d, a)) ||
         (t4 == 0 && between(c, d, b));
}
bool holds(const Flat* t, Flat p) {
  int a = turn(t[0], t[1], p), b = turn(t[1], t[2], p), c = turn(t[2], t[0], p);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

bool coplanarMeet(const Point* a, const Point* b) {
  Point n = crossed(minus(a[1], a[0]), minus(a[2], a[0]));
  Flat fa[3], fb[3];
  for (int k = 0; k < 3; k++) fa[k] = flat(a[k], n), fb[k] = flat(b[k], n);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (segmentsMeet(fa[i], fa[(i + 1) % 3], fb[j], fb[(j + 1) % 3])) return true;
  return holds(fa, fb[0]) || holds(fb, fa[0]);
}

// 0: no; 1: in a point of the boundary or an end of the edge; 2: through the inside.
int edgeMeets(const Point* t, Point p, Point q) {
  int hp = side(t, p), hq = side(t, q);
  if (hp == hq && hp != 0) return 0;
  if (hp == 0 && hq == 0) {  // the edge lies in the plane
    Point n = crossed(minus(t[1], t[0]), minus(t[2], t[0]));
    Flat f[3] = {flat(t[0], n), flat(t[1], n), flat(t[2], n)}, u = flat(p, n), v = flat(q, n);
    bool meets = holds(f, u) || holds(f, v);
    for (int k = 0; k < 3; k++) meets = meets || segmentsMeet(f[k], f[(k + 1) % 3], u, v);
    return meets ? 1 : 0;
  }
  int a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
  if (!((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))) return 0;
  return a != 0 && b != 0 && c != 0 && hp != 0 && hq != 0 ? 2 : 1;
}

}  // namespace

Meeting exactMeeting(const Triangle& ta, const Triangle& tb) {
  Point a[3], b[3];
  for (int k = 0; k < 3; k++) {
    a[k] = {Whole(ta.corner[k].x), Whole(ta.corner[k].y), Whole(ta.corner[k].z)};
    b[k] = {Whole(tb.corner[k].x), Whole(tb.corner[k].y), Whole(tb.corner[k].z)};
  }
  if (side(a, b[0]) == 0 && side(a, b[1]) == 0 && side(a, b[2]) == 0)
    return coplanarMeet(a, b) ? Meeting::coplanar : Meeting::coplanarApart;
  int most = 0;
  for (int k = 0; k < 3; k++) {
    int one = edgeMeets(a, b[k], b[(k + 1) % 3]), other = edgeMeets(b, a[k], a[(k + 1) % 3]);
    most = one > most ? one : most;
    most = other > most ? other : most;
  }
  return most == 0 ? Meeting::apart : most == 1 ? Meeting::touch : Meeting::cross;
}

}  // namespace brickfall::test
