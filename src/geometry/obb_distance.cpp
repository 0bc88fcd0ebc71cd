// Distance of two boxes by their features. The closest points of two boxes apart are either a corner of one and a point of
// the other (16 candidates, each a clamp), or they lie inside two crossing edges. In the second case the line between them
// is along A_i x B_j and both edges are the outermost along it, which leaves one edge of each per pair of axes, or a few
// where a face lies level. Every candidate is a point of A and one of B, so none can come out too near; the nearest wins.
#include "geometry/obb_rows.h"

namespace brickfall {

namespace {

// Below this squared sine the corners stand in for parallel edges; the error is the sine times the size.
template <class T> constexpr T kNoCrossing = kIsFloat<T> ? T(1e-11) : T(1e-24);
// Share of |L| up to which two parallel edges count as equally far out: above what rounding does to the direction of the
// shortest L. Too many candidates do no harm.
template <class T> constexpr T kLevel = kIsFloat<T> ? T(5e-2) : T(1e-3);

template <class T> T clamp(T value, T limit) { return value < -limit ? -limit : value > limit ? limit : value; }

template <class T> Vec3T<T> clamped(Vec3T<T> local, Vec3T<T> half) {
  return {clamp(local.x, half.x), clamp(local.y, half.y), clamp(local.z, half.z)};
}

template <class T> struct Closest {
  T squared = -1;     // negative: none yet
  Vec3T<T> onA, onB;  // relative to A's centre

  void take(Vec3T<T> pointA, Vec3T<T> pointB) {
    T found = lengthSquared(pointB - pointA);
    if (squared < 0 || found < squared) squared = found, onA = pointA, onB = pointB;
  }
};

// The axes i1, i2 across an edge, with the signs of the edges that are outermost along a direction: one, two or four.
template <class T> int outermost(T along1, T along2, T level, T signs[4][2]) {
  int count = 0;
  for (int k = 0; k < 4; k++) {
    T s1 = k & 1 ? T(-1) : T(1), s2 = k & 2 ? T(-1) : T(1);
    if (s1 * along1 < -level || s2 * along2 < -level) continue;
    signs[count][0] = s1, signs[count][1] = s2;
    count++;
  }
  return count;
}

template <class T> void takeEdges(const ObbT<T>& a, const ObbT<T>& b, Vec3T<T> d, Closest<T>& best) {
  for (int i0 = 0; i0 < 3; i0++) {
    for (int j0 = 0; j0 < 3; j0++) {
      const Vec3T<T>&alongA = a.axes.row[i0], &alongB = b.axes.row[j0];
      Vec3T<T> axis = cross(alongA, alongB);
      T squared = lengthSquared(axis);
      if (!(squared > kNoCrossing<T>)) continue;
      Vec3T<T> out = dot(axis, d) < 0 ? -axis : axis;  // from A to B
      const int i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3, j1 = (j0 + 1) % 3, j2 = (j0 + 2) % 3;
      T level = kLevel<T> * std::sqrt(squared), signsA[4][2], signsB[4][2];
      int countA = outermost(dot(out, a.axes.row[i1]), dot(out, a.axes.row[i2]), level, signsA);
      int countB = outermost(-dot(out, b.axes.row[j1]), -dot(out, b.axes.row[j2]), level, signsB);
      for (int p = 0; p < countA; p++) {
        Vec3T<T> middleA =
            a.axes.row[i1] * (signsA[p][0] * a.halfExtents[i1]) + a.axes.row[i2] * (signsA[p][1] * a.halfExtents[i2]);
        for (int q = 0; q < countB; q++) {
          Vec3T<T> middleB = d + b.axes.row[j1] * (signsB[q][0] * b.halfExtents[j1]) +
                             b.axes.row[j2] * (signsB[q][1] * b.halfExtents[j2]);
          Vec3T<T> between = middleB - middleA;
          T s = clamp(dot(cross(between, alongB), axis) / squared, a.halfExtents[i0]);
          T t = clamp(dot(cross(between, alongA), axis) / squared, b.halfExtents[j0]);
          best.take(middleA + alongA * s, middleB + alongB * t);
        }
      }
    }
  }
}

// A point that the edges of one box, start + s along with |s| <= half, share with the other; both in that other's frame.
template <class T> bool edgeInside(Vec3T<T> middle, Vec3T<T> along, T half, Vec3T<T> limits, Vec3T<T>& point) {
  T low = -half, high = half;
  for (int k = 0; k < 3; k++) {
    if (along[k] == 0) {
      if (!(std::fabs(middle[k]) <= limits[k])) return false;
      continue;
    }
    T enter = (-limits[k] - middle[k]) / along[k], leave = (limits[k] - middle[k]) / along[k];
    if (enter > leave) std::swap(enter, leave);
    if (enter > low) low = enter;
    if (leave < high) high = leave;
  }
  if (!(low <= high)) return false;
  point = clamped(middle + along * ((low + high) / 2), limits);
  return true;
}

// Overlapping boxes, unless one is inside the other (which its corners tell), cross with an edge of one of them.
template <class T> bool commonPoint(const ObbT<T>& inner, const ObbT<T>& outer, Vec3T<T> d, Vec3T<T>& point) {
  const Vec3T<T> centre = outer.axes * d;
  for (int i0 = 0; i0 < 3; i0++) {
    const int i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3;
    for (int k = 0; k < 4; k++) {
      Vec3T<T> offset = inner.axes.row[i1] * (k & 1 ? -inner.halfExtents[i1] : inner.halfExtents[i1]) +
                        inner.axes.row[i2] * (k & 2 ? -inner.halfExtents[i2] : inner.halfExtents[i2]);
      if (edgeInside(centre + outer.axes * offset, outer.axes * inner.axes.row[i0], inner.halfExtents[i0],
                     outer.halfExtents, point)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

template <class T> ObbDistanceT<T> distance(const ObbT<T>& a, const ObbT<T>& b) {
  const Vec3T<T> d = b.centre - a.centre;
  const bool touching = overlaps(a, b);
  Vec3T<T> point;
  if (touching && commonPoint(b, a, d, point)) {
    point = toWorld(a, point);
    return {0, point, point};
  }
  if (touching && commonPoint(a, b, -d, point)) {
    point = toWorld(b, point);
    return {0, point, point};
  }
  Closest<T> best;
  for (int k = 0; k < 8; k++) {
    auto corner = [k](const ObbT<T>& box) {
      Vec3T<T> h = box.halfExtents;
      return transposeTimes(box.axes, Vec3T<T>{k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
    };
    Vec3T<T> ofA = corner(a), ofB = d + corner(b);
    best.take(transposeTimes(a.axes, clamped(a.axes * ofB, a.halfExtents)), ofB);
    best.take(ofA, d + transposeTimes(b.axes, clamped(b.axes * (ofA - d), b.halfExtents)));
  }
  takeEdges(a, b, d, best);
  return {touching ? T(0) : std::sqrt(best.squared), a.centre + best.onA, a.centre + best.onB};
}

template ObbDistanceT<float> distance(const ObbT<float>&, const ObbT<float>&);
template ObbDistanceT<double> distance(const ObbT<double>&, const ObbT<double>&);

}  // namespace brickfall
