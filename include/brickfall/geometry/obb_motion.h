// Moving oriented boxes: when they first touch, which of the fifteen rows was the last to separate them, and where they
// touch. Rows, sigma and conventions as in geometry/obb.h and docs/geometry.md.
#pragma once
#include "brickfall/geometry/obb.h"

namespace brickfall {

// Two boxes at time 0 and how they move. World frame.
template <class T> struct ObbMotionT {
  ObbT<T> a, b;
  Vec3T<T> velocityA, velocityB;  // of the centres, m/s, constant
  Vec3T<T> spinA, spinB;  // angular velocities, rad/s, constant, about the centres; only firstContactTurning reads them
};
using ObbMotion = ObbMotionT<double>;
using ObbMotionF = ObbMotionT<float>;

// The box after `time` seconds. Turns of more than 1e5 rad count as 1e5.
template <class T> ObbT<T> advanced(const ObbT<T>& box, Vec3T<T> velocity, Vec3T<T> spin, T time);

// What counts as equal, as a share of a size. 0 = the default of the precision: 1e-9 (double), 1e-5 (float). Larger values
// find whole faces where boxes stand a little askew.
template <class T> struct ObbLimitsT {
  T tie = 0;  // rows that part or meet within this share of |a| + |b| of travel; also by how much points may miss a box
  T flat = 0;  // a face or edge whose ends lie level to this share of its own box's half diagonal touches as a whole
};

// --- where two touching boxes touch

// The point by the table of coefficients (the report's Appendix B, from Eberly): each coordinate is plus or minus a half
// extent by the signs of the row, the two along crossing edges from the lines' closest points. It is a contact point only if
// `unique`; otherwise a coefficient is zero (a face or edge lies flat) and the bare table takes Sign(0) = +1.
template <class T> struct ObbTablePointT {
  Vec3T<T> point;       // world
  Vec3T<T> onA, onB;    // the same in local coordinates of A (x) and B (y)
  bool unique = false;  // no coefficient is zero
  bool inside = false;  // the point is in both boxes
};
// sigma: +1 or -1, the side of the row's axis on which B lies, as rowGaps has it.
template <class T>
ObbTablePointT<T> tablePoint(const ObbT<T>& a, const ObbT<T>& b, int row, int sigma, ObbLimitsT<T> limits = {});

template <class T> struct ObbContactPointT {
  Vec3T<T> position;  // world
  T depth = 0;        // m, how far one box is inside the other here, along the normal
};
// All points in which the two touch: a point, a segment or a convex polygon.
template <class T> struct ObbContactSetT {
  int row = -1, sigma = 1;  // the row that was used
  Vec3T<T> normal;          // unit, from A to B
  int count = 0;            // 1, 2, or 3..8: corners in order around the polygon
  std::array<ObbContactPointT<T>, 8> points;
  bool unique = false;     // count == 1: the only point in which they touch
  bool byTable = false;    // it came from the table's coefficients
  bool estimated = false;  // no features met; the point is the middle between the closest points
  Vec3T<T> point;          // the unique point, or the mean of the points; world
  Vec3T<T> onA, onB;       // the same in local coordinates of A (x) and B (y)
};
// The features of A outermost along the normal of a row and of B outermost against it, cut with each other.
template <class T>
ObbContactSetT<T> contactSet(const ObbT<T>& a, const ObbT<T>& b, int row, int sigma, ObbLimitsT<T> limits = {});

// --- when

enum class ObbHit : std::uint8_t {
  none,         // not within the time asked for
  contact,      // apart at first, then touching
  overlapping,  // they touch or overlap at time 0; the contact set is that of the least depth
  undecided,    // turning boxes only: gave up after the most steps allowed
};

template <class T> struct ObbImpactT {
  ObbHit hit = ObbHit::none;
  T time = 0;     // s, of the first contact; 0 if overlapping
  T leaving = 0;  // s, when they are apart again if nothing stops them; infinite if never
  int row = -1;   // contact row: the last that separated them (of rows that tie the first); overlapping: least depth
  std::uint16_t tied = 0;     // bit k: row k met at the same time
  T depth = 0;                // m, overlapping only
  ObbContactSetT<T> contact;  // at `time`
};
using ObbImpact = ObbImpactT<double>;
using ObbImpactF = ObbImpactT<float>;

// First contact in [0, maxTime] under constant velocities, without rotation. maxTime may be infinite. Errors: an invalid
// box, a velocity that is not finite, a negative time or limit.
template <class T>
Result<ObbImpactT<T>> firstContact(const ObbMotionT<T>& motion, T maxTime, ObbLimitsT<T> limits = {});

// With rotation, by conservative advancement: the boxes are moved by no more than their distance allows, until they are
// within `tolerance` m. They are proven apart before `time`. Computed in double whatever T.
template <class T> struct ObbTurningImpactT {
  ObbHit hit = ObbHit::none;
  T time = 0;              // s: no contact before it (to rounding)
  T gap = 0;               // m, distance at `time`: at most `tolerance` if hit is contact; the error in position
  bool confirmed = false;  // an overlap was found soon after: the contact lies in [time, latest]
  T latest = 0;            // s; if not confirmed they may pass each other within `tolerance`
  int steps = 0;
  ObbContactSetT<T> contact;  // of contact and overlapping, at `time`
};
// maxTime finite; tolerance > 0, at least 1e-12 of the size. At most 10000 steps, then undecided.
template <class T>
Result<ObbTurningImpactT<T>> firstContactTurning(const ObbMotionT<T>& motion, T maxTime, T tolerance);

}  // namespace brickfall
