// First contact of boxes that also turn, by conservative advancement (Mirtich 1996). Along the unit direction n between the
// closest points, no point of A comes nearer to B faster than
//   n . (vA - vB) + |n x spinA| |a| + |n x spinB| |b|          (|a|, |b|: half diagonals)
// at any later time, because n is held fixed while r in n . (spin x r) turns. So time may go on by the distance over that
// speed without a contact; and if the speed is not positive there never is one.
#include <limits>

#include "geometry/obb_checks.h"
#include "geometry/obb_contact.h"

namespace brickfall {

namespace {

constexpr int kMostSteps = 10000;

template <class To, class From> Vec3T<To> converted(Vec3T<From> v) { return {To(v.x), To(v.y), To(v.z)}; }
template <class To, class From> ObbT<To> converted(const ObbT<From>& box) {
  const Vec3T<From>* row = box.axes.row;
  return {converted<To>(box.centre),
          {{converted<To>(row[0]), converted<To>(row[1]), converted<To>(row[2])}},
          converted<To>(box.halfExtents)};
}
template <class To, class From> ObbContactSetT<To> converted(const ObbContactSetT<From>& c) {
  ObbContactSetT<To> out;
  out.row = c.row, out.sigma = c.sigma, out.count = c.count;
  out.normal = converted<To>(c.normal);
  for (int k = 0; k < c.count; k++) out.points[k] = {converted<To>(c.points[k].position), To(c.points[k].depth)};
  out.unique = c.unique, out.byTable = c.byTable, out.estimated = c.estimated;
  out.point = converted<To>(c.point), out.onA = converted<To>(c.onA), out.onB = converted<To>(c.onB);
  return out;
}

// In single precision axes are unit to 1e-7 only, which turning in double would carry along.
Obb orthonormal(const Obb& box) {
  Obb out = box;
  out.axes.row[0] = normalized(box.axes.row[0]);
  out.axes.row[2] = normalized(cross(out.axes.row[0], box.axes.row[1]));
  out.axes.row[1] = cross(out.axes.row[2], out.axes.row[0]);
  return out;
}

struct Motion {
  Obb a, b;
  Vec3 velocityA, velocityB, spinA, spinB;
  Obb boxA(double time) const { return advanced(a, velocityA, spinA, time); }
  Obb boxB(double time) const { return advanced(b, velocityB, spinB, time); }
  bool overlap(double time) const { return overlaps(boxA(time), boxB(time)); }
};

// An overlap soon after `time`, as early as bisection finds one.
void confirm(const Motion& motion, double first, double maxTime, ObbTurningImpactT<double>& out) {
  double apart = out.time, step = first;
  for (int k = 0; k < 12; k++, step *= 2) {
    double probe = out.time + step < maxTime ? out.time + step : maxTime;
    if (motion.overlap(probe)) {
      for (int half = 0; half < 20; half++) {
        double middle = apart + (probe - apart) * 0.5;
        (motion.overlap(middle) ? probe : apart) = middle;
      }
      out.confirmed = true;
      out.latest = probe;
      return;
    }
    if (probe >= maxTime) return;
    apart = probe;
  }
}

// The row that separates most is the one that is about to meet.
void describe(const Obb& a, const Obb& b, double tolerance, ObbTurningImpactT<double>& out) {
  ObbGapsT<double> gaps = rowGaps(a, b);
  double highest = -std::numeric_limits<double>::infinity();
  for (int row = 0; row < kObbRows; row++) {
    if (gaps.used >> row & 1 && gaps.gap[row] > highest) highest = gaps.gap[row];
  }
  const double size = pairSize(a, b), share = tolerance / size;
  RowSide rows[kObbRows];
  std::size_t count = 0;
  for (int row = 0; row < kObbRows; row++) {
    if (gaps.used >> row & 1 && gaps.gap[row] >= highest - 2 * tolerance) rows[count++] = {row, gaps.sigma[row]};
  }
  ObbLimitsT<double> limits{3 * share < 0.5 ? 3 * share : 0.5, 0};
  out.contact = contactOfRows<double>(a, b, b.centre - a.centre, {rows, count}, limits);
  moveToWorld(out.contact, a.centre);
}

ObbTurningImpactT<double> advance(const Motion& motion, double maxTime, double tolerance) {
  const double radiusA = length(motion.a.halfExtents), radiusB = length(motion.b.halfExtents);
  ObbTurningImpactT<double> out;
  for (out.steps = 0; out.steps < kMostSteps; out.steps++) {
    Obb a = motion.boxA(out.time), b = motion.boxB(out.time);
    ObbDistanceT<double> closest = distance(a, b);
    out.gap = closest.distance;
    Vec3 n = normalized(closest.onB - closest.onA);
    double closing = dot(n, motion.velocityA - motion.velocityB) + length(cross(n, motion.spinA)) * radiusA +
                     length(cross(n, motion.spinB)) * radiusB;
    if (!(closest.distance > tolerance)) {
      out.hit = out.time > 0 || closest.distance > 0 ? ObbHit::contact : ObbHit::overlapping;
      if (out.hit == ObbHit::contact && closing > 0) confirm(motion, tolerance / closing, maxTime, out);
      if (out.hit == ObbHit::overlapping) out.confirmed = true, out.latest = 0;
      describe(a, b, tolerance, out);
      return out;
    }
    // Half the tolerance is kept for rounding in the distance and the turned axes.
    double step = closing > 0 ? (closest.distance - 0.5 * tolerance) / closing : maxTime;
    if (!(out.time + step < maxTime)) return out;  // none: they stay apart to the end
    out.time += step;
  }
  out.hit = ObbHit::undecided;
  return out;
}

}  // namespace

template <class T> ObbT<T> advanced(const ObbT<T>& box, Vec3T<T> velocity, Vec3T<T> spin, T time) {
  ObbT<T> out = box;
  out.centre += velocity * time;
  if (spin == Vec3T<T>{}) return out;
  Mat3 turn = toMatrix(quatFromRotationVector(converted<double>(spin) * double(time)));
  for (int k = 0; k < 3; k++) out.axes.row[k] = converted<T>(turn * converted<double>(box.axes.row[k]));
  return out;
}

template <class T>
Result<ObbTurningImpactT<T>> firstContactTurning(const ObbMotionT<T>& motion, T maxTime, T tolerance) {
  if (Status good = checkMotion(motion); !good) return good.error();
  if (!(maxTime >= 0 && maxTime <= std::numeric_limits<T>::max())) {
    return badNumber("maxTime", double(maxTime), "0 or more, finite");
  }
  const double least = 1e-12 * double(pairSize(motion.a, motion.b));
  if (!(tolerance > 0 && double(tolerance) >= least && tolerance <= std::numeric_limits<T>::max())) {
    return badNumber("tolerance", double(tolerance), "more than 0, at least 1e-12 of the boxes' size, finite");
  }
  Motion exact{orthonormal(converted<double>(motion.a)), orthonormal(converted<double>(motion.b)),
               converted<double>(motion.velocityA),      converted<double>(motion.velocityB),
               converted<double>(motion.spinA),          converted<double>(motion.spinB)};
  ObbTurningImpactT<double> found = advance(exact, double(maxTime), double(tolerance));
  ObbTurningImpactT<T> out;
  out.hit = found.hit, out.confirmed = found.confirmed, out.steps = found.steps;
  out.time = T(found.time), out.gap = T(found.gap), out.latest = T(found.latest);
  out.contact = converted<T>(found.contact);
  return out;
}

#define BRICKFALL_OBB_TURNING(T)                                    \
  template ObbT<T> advanced(const ObbT<T>&, Vec3T<T>, Vec3T<T>, T); \
  template Result<ObbTurningImpactT<T>> firstContactTurning(const ObbMotionT<T>&, T, T);
BRICKFALL_OBB_TURNING(float)
BRICKFALL_OBB_TURNING(double)
#undef BRICKFALL_OBB_TURNING

}  // namespace brickfall
