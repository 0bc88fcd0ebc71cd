// Where two touching boxes touch. All is relative to A's centre and along its row's normal n (unit, from A to B). Of each box
// the outermost feature along n is taken: coordinate k is free where both ends lie level, else plus or minus the half extent.
// No, one, two free coordinates make a corner, an edge, a face. The table's coefficients are the case in which that
// leaves one point; everything else is the smaller feature cut to the larger one.
#include "geometry/obb_contact.h"

#include <cstdint>

namespace brickfall {

namespace {

constexpr int kMostPoints = 8;

template <class T> struct Feature {
  Vec3T<T> middle;  // of the feature, relative to A's centre
  Vec3T<T> centre;  // of the box, the same
  const Mat3T<T>* axes = nullptr;
  Vec3T<T> half;
  int freeCount = 0;
  bool free[3] = {false, false, false};
  T furthest = 0;  // n . middle

  bool contains(Vec3T<T> point, T slack) const {
    Vec3T<T> local = *axes * (point - centre);
    for (int k = 0; k < 3; k++) {
      if (!(std::fabs(local[k]) <= half[k] + slack)) return false;
    }
    return true;
  }
};

template <class T> T sign(T value) { return value < 0 ? T(-1) : T(1); }

// Outermost of a box along `out`.
template <class T> Feature<T> outermost(const ObbT<T>& box, Vec3T<T> centre, Vec3T<T> out, T flat) {
  Feature<T> f;
  f.axes = &box.axes, f.half = box.halfExtents;
  f.centre = f.middle = centre;
  const T level = flat * length(box.halfExtents);
  for (int k = 0; k < 3; k++) {
    T along = dot(out, box.axes.row[k]);
    f.free[k] = std::fabs(along) * box.halfExtents[k] <= level;
    if (f.free[k]) {
      f.freeCount++;
    } else {
      f.middle += box.axes.row[k] * (sign(along) * box.halfExtents[k]);
    }
  }
  return f;
}

template <class T> struct Outline {
  Vec3T<T> points[kMostPoints + 1];
  int count = 0;
  void add(Vec3T<T> p) {
    if (count <= kMostPoints) points[count++] = p;
  }
};

template <class T> Outline<T> outlineOf(const Feature<T>& f) {
  Outline<T> out;
  int axis[3], count = 0;
  for (int k = 0; k < 3; k++) {
    if (f.free[k] && count < 2) axis[count++] = k;
  }
  auto side = [&](int k) { return f.axes->row[axis[k]] * f.half[axis[k]]; };
  if (count == 0) {
    out.add(f.middle);
  } else if (count == 1) {
    out.add(f.middle - side(0));
    out.add(f.middle + side(0));
  } else {
    out.add(f.middle - side(0) - side(1));
    out.add(f.middle + side(0) - side(1));
    out.add(f.middle + side(0) + side(1));
    out.add(f.middle - side(0) + side(1));
  }
  return out;
}

// The part of the outline with dot(axis, p) <= limit (Sutherland, Hodgman 1974); a segment stays a segment.
template <class T> Outline<T> cut(const Outline<T>& in, Vec3T<T> axis, T limit) {
  Outline<T> out;
  for (int k = 0; k < in.count; k++) {
    Vec3T<T> p = in.points[k], q = in.points[(k + 1) % in.count];
    T overP = dot(axis, p) - limit, overQ = dot(axis, q) - limit;
    if (overP <= 0) out.add(p);
    bool lastOfSegment = in.count <= 2 && k + 1 == in.count;
    if (!lastOfSegment && (overP <= 0) != (overQ <= 0)) out.add(p + (q - p) * (overP / (overP - overQ)));
  }
  return out;
}

// Points closer than `apart` become one.
template <class T> void merge(Outline<T>& outline, T apart) {
  int kept = 0;
  for (int k = 0; k < outline.count; k++) {
    bool known = false;
    for (int p = 0; p < kept && !known; p++)
      known = lengthSquared(outline.points[p] - outline.points[k]) <= apart * apart;
    if (!known) outline.points[kept++] = outline.points[k];
  }
  outline.count = kept;
}

// The crossing of two edges, as in the table but with the midpoints' difference formed before anything is divided: the
// error grows like 1 / sine of their angle, not its square.
template <class T> struct Crossing {
  T onA, onB;  // along the edges
};
template <class T> Crossing<T> crossing(Vec3T<T> middleA, Vec3T<T> alongA, Vec3T<T> middleB, Vec3T<T> alongB) {
  Vec3T<T> axis = cross(alongA, alongB), between = middleB - middleA;
  T squared = lengthSquared(axis);
  return {dot(cross(between, alongB), axis) / squared, dot(cross(between, alongA), axis) / squared};
}

template <class T> Vec3T<T> unitAxis(const ObbT<T>& a, const ObbT<T>& b, int row, int sigma) {
  return normalized(obbRowAxis(a, b, row)) * T(sigma < 0 ? -1 : 1);
}

template <class T> bool rowUsable(const ObbT<T>& a, const ObbT<T>& b, int row) {
  if (row < 0 || row >= kObbRows) return false;
  return row < kObbFaceRows || lengthSquared(obbRowAxis(a, b, row)) > kParallelSquared<T>;
}

template <class T> struct Pair {
  const ObbT<T>&a, &b;
  Vec3T<T> d;  // centre of B
  T slack;     // m
};

// The table. Row 0..2: corner of B; 3..5: corner of A; 6..14: crossing edges.
template <class T> ObbTablePointT<T> fromTable(const Pair<T>& pair, int row, int sigma, T flat) {
  ObbTablePointT<T> out;
  if (!rowUsable(pair.a, pair.b, row)) return out;
  const Vec3T<T> n = unitAxis(pair.a, pair.b, row, sigma);
  const T levelA = flat * length(pair.a.halfExtents), levelB = flat * length(pair.b.halfExtents);
  const int i0 = row < kObbFaceRows ? row : (row - 6) / 3, j0 = row < kObbFaceRows ? row - 3 : (row - 6) % 3;
  Vec3T<T> x, y, point;
  out.unique = true;
  auto coefficients = [&](const ObbT<T>& box, T side, T level, int except) {
    Vec3T<T> coordinates;
    for (int k = 0; k < 3; k++) {
      if (k == except) continue;
      T along = side * dot(n, box.axes.row[k]);
      coordinates[k] = sign(along) * box.halfExtents[k];
      if (std::fabs(along) * box.halfExtents[k] <= level) out.unique = false;
    }
    return coordinates;
  };
  if (row < 3) {
    y = coefficients(pair.b, T(-1), levelB, -1);
    point = pair.d + transposeTimes(pair.b.axes, y);
    x = pair.a.axes * point;
  } else if (row < kObbFaceRows) {
    x = coefficients(pair.a, T(1), levelA, -1);
    point = transposeTimes(pair.a.axes, x);
    y = pair.b.axes * (point - pair.d);
  } else {
    x = coefficients(pair.a, T(1), levelA, i0);
    y = coefficients(pair.b, T(-1), levelB, j0);
    Vec3T<T> middleA = transposeTimes(pair.a.axes, x), middleB = pair.d + transposeTimes(pair.b.axes, y);
    Crossing<T> cross = crossing(middleA, pair.a.axes.row[i0], middleB, pair.b.axes.row[j0]);
    x[i0] = cross.onA, y[j0] = cross.onB;
    point = (middleA + pair.a.axes.row[i0] * cross.onA + middleB + pair.b.axes.row[j0] * cross.onB) * T(.5);
  }
  out.point = point, out.onA = x, out.onB = y;
  Vec3T<T> locals[2] = {x, y}, halves[2] = {pair.a.halfExtents, pair.b.halfExtents};
  out.inside = true;
  for (int side = 0; side < 2; side++) {
    for (int k = 0; k < 3; k++) {
      if (!(std::fabs(locals[side][k]) <= halves[side][k] + pair.slack)) out.inside = false;
    }
  }
  return out;
}

template <class T> void setPoint(ObbContactSetT<T>& out, const Pair<T>& pair, Vec3T<T> point) {
  out.point = point;
  out.onA = pair.a.axes * point;
  out.onB = pair.b.axes * (point - pair.d);
}

template <class T> bool tryTable(const Pair<T>& pair, int row, int sigma, T flat, T depth, ObbContactSetT<T>& out) {
  ObbTablePointT<T> found = fromTable(pair, row, sigma, flat);
  if (!found.unique || !found.inside) return false;
  out.count = 1;
  out.unique = out.byTable = true;
  out.points[0] = {found.point, depth};
  out.point = found.point, out.onA = found.onA, out.onB = found.onB;
  return true;
}

template <class T> bool tryCut(const Pair<T>& pair, int row, Vec3T<T> n, T flat, ObbContactSetT<T>& out) {
  Feature<T> ofA = outermost(pair.a, Vec3T<T>{}, n, flat), ofB = outermost(pair.b, pair.d, -n, flat);
  bool largerIsA = ofA.freeCount != ofB.freeCount ? ofA.freeCount > ofB.freeCount : row < 3 || row >= kObbFaceRows;
  const Feature<T>&larger = largerIsA ? ofA : ofB, &smaller = largerIsA ? ofB : ofA;
  Outline<T> outline = outlineOf(smaller);
  for (int k = 0; k < 3; k++) {
    if (!larger.free[k]) continue;
    Vec3T<T> axis = larger.axes->row[k];
    T middle = dot(axis, larger.centre), reach = larger.half[k] + pair.slack;
    outline = cut(outline, axis, middle + reach);
    outline = cut(outline, -axis, reach - middle);
  }
  merge(outline, 4 * pair.slack);
  T surface = dot(n, larger.middle), side = largerIsA ? T(1) : T(-1);
  Vec3T<T> sum;
  out.count = 0;
  for (int k = 0; k < outline.count && out.count < kMostPoints; k++) {
    Vec3T<T> p = outline.points[k];
    T depth = side * (surface - dot(n, p));
    // Level only to `flat`: what stands clear of the other box does not touch it.
    T tolerance = pair.slack + flat * (length(ofA.half) + length(ofB.half));
    if (!(depth >= -tolerance)) continue;
    if (larger.freeCount < 2 && !(ofA.contains(p, tolerance) && ofB.contains(p, tolerance))) continue;
    out.points[out.count++] = {p, depth > 0 ? depth : 0};
    sum += p;
  }
  if (out.count == 0) return false;
  out.unique = out.count == 1;
  out.byTable = false;
  setPoint(out, pair, sum * (1 / T(out.count)));
  return true;
}

}  // namespace

template <class T>
ObbContactSetT<T> contactOfRows(const ObbT<T>& a, const ObbT<T>& b, Vec3T<T> d, std::span<const RowSide> rows,
                                ObbLimitsT<T> limits) {
  const T size = pairSize(a, b);
  const T flat = limits.flat > 0 ? limits.flat : kTie<T>;
  const Pair<T> pair{a, b, d, (limits.tie > 0 ? limits.tie : kTie<T>)*size};
  // The second round is for boxes so nearly parallel that their edge rows are skipped: what they meet with are corners and
  // edges that no remaining row names, and which as faces lie flat.
  for (T level : {flat, 1000 * flat}) {
    for (RowSide side : rows) {
      if (!rowUsable(a, b, side.row)) continue;
      ObbContactSetT<T> out;
      out.row = side.row, out.sigma = side.sigma < 0 ? -1 : 1;
      out.normal = unitAxis(a, b, side.row, out.sigma);
      T reach = 0;
      for (int k = 0; k < 3; k++) {
        reach += a.halfExtents[k] * std::fabs(dot(out.normal, a.axes.row[k])) +
                 b.halfExtents[k] * std::fabs(dot(out.normal, b.axes.row[k]));
      }
      T depth = reach - dot(out.normal, d);
      if (tryTable(pair, side.row, out.sigma, level, depth > 0 ? depth : T(0), out) ||
          tryCut(pair, side.row, out.normal, level, out)) {
        return out;
      }
    }
  }
  ObbContactSetT<T> out;
  if (!rows.empty()) {
    out.row = rows[0].row, out.sigma = rows[0].sigma < 0 ? -1 : 1;
    out.normal = unitAxis(a, b, out.row, out.sigma);
  }
  ObbT<T> fromA = a, fromB = b;
  fromA.centre = {}, fromB.centre = d;
  ObbDistanceT<T> closest = distance(fromA, fromB);
  out.count = 1;
  out.estimated = true;
  out.points[0].position = (closest.onA + closest.onB) * T(.5);
  setPoint(out, pair, out.points[0].position);
  return out;
}

template <class T> void moveToWorld(ObbContactSetT<T>& contact, Vec3T<T> centreA) {
  contact.point += centreA;
  for (int k = 0; k < contact.count; k++) contact.points[k].position += centreA;
}

template <class T>
ObbTablePointT<T> tablePoint(const ObbT<T>& a, const ObbT<T>& b, int row, int sigma, ObbLimitsT<T> limits) {
  T slack = (limits.tie > 0 ? limits.tie : kTie<T>)*pairSize(a, b);
  ObbTablePointT<T> out =
      fromTable(Pair<T>{a, b, b.centre - a.centre, slack}, row, sigma, limits.flat > 0 ? limits.flat : kTie<T>);
  out.point += a.centre;
  return out;
}

template <class T>
ObbContactSetT<T> contactSet(const ObbT<T>& a, const ObbT<T>& b, int row, int sigma, ObbLimitsT<T> limits) {
  RowSide side{row, sigma};
  ObbContactSetT<T> out = contactOfRows(a, b, b.centre - a.centre, {&side, 1}, limits);
  moveToWorld(out, a.centre);
  return out;
}

#define BRICKFALL_OBB_CONTACT(T)                                                                               \
  template ObbContactSetT<T> contactOfRows(const ObbT<T>&, const ObbT<T>&, Vec3T<T>, std::span<const RowSide>, \
                                           ObbLimitsT<T>);                                                     \
  template void moveToWorld(ObbContactSetT<T>&, Vec3T<T>);                                                     \
  template ObbTablePointT<T> tablePoint(const ObbT<T>&, const ObbT<T>&, int, int, ObbLimitsT<T>);              \
  template ObbContactSetT<T> contactSet(const ObbT<T>&, const ObbT<T>&, int, int, ObbLimitsT<T>);
BRICKFALL_OBB_CONTACT(float)
BRICKFALL_OBB_CONTACT(double)
#undef BRICKFALL_OBB_CONTACT

}  // namespace brickfall
