// First contact of boxes that move without turning. Along each row the distance of the centres changes linearly, so the row
// overlaps during one interval of time; they touch while all do. The contact row is the one whose interval begins last.
#include "brickfall/geometry/obb_motion.h"

#include <limits>

#include "geometry/obb_checks.h"
#include "geometry/obb_contact.h"

namespace brickfall {

namespace {

template <class T> struct Interval {
  T enter, leave;
  bool never = false;
};

template <class T> struct Intervals {
  T enter[kObbRows];  // of rows that are not skipped and do meet
  std::int8_t sigma[kObbRows];
  T first, last;  // of the interval in which all rows overlap
  std::uint16_t used = 0;
  bool never = false;
};

template <class T> constexpr T kInfinite = std::numeric_limits<T>::infinity();

// along: distance of the centres at time 0; rate: its change; both, and reach, times |L|. Motion across the axis is no
// motion along it though rounding makes it one, and then a row that touches to rounding stays in touch.
template <class T> Interval<T> intervalOf(T along, T rate, T reach, T stillBelow, T slack) {
  if (!(std::fabs(rate) > stillBelow)) {
    return {-kInfinite<T>, kInfinite<T>, !(std::fabs(along) <= reach + slack)};
  }
  T one = (reach - along) / rate, other = (-reach - along) / rate;
  return one < other ? Interval<T>{one, other} : Interval<T>{other, one};
}

template <class T> Intervals<T> intervals(const ObbMotionT<T>& motion, Vec3T<T> w) {
  const ObbRows<T> rows(motion.a, motion.b);
  const Vec3T<T> wA = motion.a.axes * w, wB = motion.b.axes * w;
  const T rounding = 16 * std::numeric_limits<T>::epsilon();
  const T speed = length(w), extent = pairSize(motion.a, motion.b) + length(rows.dA);
  Intervals<T> out;
  out.first = -kInfinite<T>, out.last = kInfinite<T>;
  eachRow([&](auto row) {
    if (!rows.template used<row>()) return;
    T size = row < kObbFaceRows ? T(1) : std::sqrt(rows.template squared<row>());
    T along = rows.template along<row>(rows.dA, rows.dB), rate = rows.template along<row>(wA, wB);
    Interval<T> in =
        intervalOf(along, rate, rows.template reach<row>(), rounding * speed * size, rounding * extent * size);
    out.never = out.never || in.never;
    out.used = std::uint16_t(out.used | 1 << row);
    out.enter[row] = in.enter;
    out.sigma[row] = along < 0 ? -1 : 1;
    if (in.enter > out.first) out.first = in.enter;
    if (in.leave < out.last) out.last = in.leave;
  });
  return out;
}

// Overlapping at time 0: no row was last to separate, so the row of least depth stands in, and those that tie with it.
template <class T> void describeOverlap(const ObbMotionT<T>& motion, T tie, ObbLimitsT<T> limits, ObbImpactT<T>& out) {
  out.hit = ObbHit::overlapping;
  out.time = 0;
  ObbGapsT<T> gaps = rowGaps(motion.a, motion.b);
  T highest = -kInfinite<T>;
  for (int row = 0; row < kObbRows; row++) {
    if (gaps.used >> row & 1 && gaps.gap[row] > highest) highest = gaps.gap[row];
  }
  RowSide rows[kObbRows];
  std::size_t count = 0;
  for (int row = 0; row < kObbRows; row++) {
    if (!(gaps.used >> row & 1) || !(gaps.gap[row] >= highest - tie)) continue;
    out.tied = std::uint16_t(out.tied | 1 << row);
    rows[count++] = {row, gaps.sigma[row]};
  }
  if (count == 0) return;
  out.row = rows[0].row;
  out.depth = gaps.gap[out.row] < 0 ? -gaps.gap[out.row] : 0;
  out.contact = contactOfRows<T>(motion.a, motion.b, motion.b.centre - motion.a.centre, {rows, count}, limits);
  moveToWorld(out.contact, motion.a.centre);
}

template <class T>
void describeContact(const ObbMotionT<T>& motion, Vec3T<T> w, const Intervals<T>& in, T tie, ObbLimitsT<T> limits,
                     ObbImpactT<T>& out) {
  out.hit = ObbHit::contact;
  out.time = in.first;
  const T speed = length(w);
  RowSide rows[kObbRows];
  std::size_t count = 0;
  for (int row = 0; row < kObbRows; row++) {
    if (!(in.used >> row & 1) || !((in.first - in.enter[row]) * speed <= tie)) continue;
    out.tied = std::uint16_t(out.tied | 1 << row);
    rows[count++] = {row, in.sigma[row]};
  }
  out.row = rows[0].row;  // at least the row that begins last is among them
  Vec3T<T> d = (motion.b.centre - motion.a.centre) + w * in.first;
  out.contact = contactOfRows<T>(motion.a, motion.b, d, {rows, count}, limits);
  moveToWorld(out.contact, motion.a.centre + motion.velocityA * in.first);
}

}  // namespace

template <class T> Result<ObbImpactT<T>> firstContact(const ObbMotionT<T>& motion, T maxTime, ObbLimitsT<T> limits) {
  if (Status good = checkMotion(motion); !good) return good.error();
  if (!(maxTime >= 0)) return badNumber("maxTime", double(maxTime), "0 or more");
  if (!(limits.tie >= 0 && limits.tie < 1))
    return badNumber("limits.tie", double(limits.tie), "0 or more, less than 1");
  if (!(limits.flat >= 0 && limits.flat < 1)) {
    return badNumber("limits.flat", double(limits.flat), "0 or more, less than 1");
  }
  const Vec3T<T> w = motion.velocityB - motion.velocityA;
  const T tie = (limits.tie > 0 ? limits.tie : kTie<T>)*pairSize(motion.a, motion.b);
  const Intervals<T> in = intervals(motion, w);
  ObbImpactT<T> out;
  out.leaving = in.last;
  if (overlaps(motion.a, motion.b) || (!in.never && in.first <= 0 && in.last >= 0)) {
    describeOverlap(motion, tie, limits, out);
  } else if (!in.never && in.first <= in.last && in.first >= 0 && in.first <= maxTime) {
    describeContact(motion, w, in, tie, limits, out);
  }
  if (out.hit == ObbHit::none) out.leaving = 0;
  return out;
}

template Result<ObbImpactT<float>> firstContact(const ObbMotionT<float>&, float, ObbLimitsT<float>);
template Result<ObbImpactT<double>> firstContact(const ObbMotionT<double>&, double, ObbLimitsT<double>);

}  // namespace brickfall
