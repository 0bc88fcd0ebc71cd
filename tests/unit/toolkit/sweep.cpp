#include "sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "obb_cases.h"
#include "pair_families.h"
#include "slow_boxes.h"

namespace brickfall::test {

namespace {

constexpr int kFamilies = int(Family::count);

// Lengths as a share of the size. Verdicts are asked for beyond `verdict`, where a skipped row (kParallelSquared) can hide
// no gap and rounding on a row just above it can make none: docs/geometry.md has the measured errors.
template <class T> struct Tolerances;
template <> struct Tolerances<double> {
  static constexpr double verdict = 1e-7, gap = 1e-7, distance = 1e-10, time = 1e-7;
};
template <> struct Tolerances<float> {
  static constexpr double verdict = 2e-3, gap = 2e-3, distance = 2e-6, time = 4e-3;
};

struct Counts {
  int pairs = 0, apart = 0, overlapping = 0, borderline = 0, byEdge = 0, wrong = 0;
  double worstDistance = 0, worstDepth = 0, worstVerdict = 0;
};

// What rounding of the centres alone does.
template <class T> double centreRounding(const Obb& a, const Obb& b) {
  double furthest = 0;
  for (int k = 0; k < 3; k++) furthest = std::max({furthest, std::fabs(a.centre[k]), std::fabs(b.centre[k])});
  return 8 * double(std::numeric_limits<T>::epsilon()) * furthest;
}

template <class T> Obb exactBox(const ObbT<T>& box) {
  return {exactly(box.centre),
          {{exactly(box.axes.row[0]), exactly(box.axes.row[1]), exactly(box.axes.row[2])}},
          exactly(box.halfExtents)};
}

template <class T> void lookAt(const FamilyPair& pair, Counts& counts) {
  using Limit = Tolerances<T>;
  const ObbT<T> a = as<T>(pair.motion.a), b = as<T>(pair.motion.b);
  // The slow method sees the same numbers, rounded to T.
  const SlowBox slowA(exactBox(a)), slowB(exactBox(b));
  const double size = length(slowA.box.halfExtents) + length(slowB.box.halfExtents);
  const double gap = slowGap(slowA, slowB), rounding = centreRounding<T>(slowA.box, slowB.box);
  const int first = firstSeparatingRow(a, b);
  const bool found = first < 0;
  counts.pairs++;
  (gap > 0 ? counts.apart : counts.overlapping)++;
  counts.byEdge += first >= kObbFaceRows;
  if (found != !(gap > 0)) {
    counts.worstVerdict = std::max(counts.worstVerdict, std::fabs(gap) / size);
    counts.borderline++;
    if (std::fabs(gap) > Limit::verdict * size + rounding) counts.wrong++;
  }
  const ObbGapsT<T> gaps = rowGaps(a, b);
  EXPECT_EQ(gaps.separating != 0, !found);
  EXPECT_EQ(overlaps(a, b), found);
  double distanceError = std::fabs(double(distance(a, b).distance) - std::max(gap, 0.0));
  if (found == !(gap > 0)) {
    counts.worstDistance = std::max(counts.worstDistance, (distanceError - rounding) / size);
    if (!(distanceError <= Limit::distance * size + rounding)) counts.wrong++;
  }
  if (found && gap <= 0) {
    auto least = leastPenetration(a, b);
    ASSERT_TRUE(least);
    double depthError = std::fabs(double(least->depth) + gap);
    counts.worstDepth = std::max(counts.worstDepth, (depthError - rounding) / size);
    if (!(depthError <= Limit::gap * size + rounding)) counts.wrong++;
    // Pushed along the normal by the depth and a little more, they are apart.
    if (least->signKnown) {
      Obb pushed = slowB.box;
      pushed.centre += exactly(least->normal) * (double(least->depth) + 2 * Limit::gap * size + rounding);
      if (slowOverlap(slowA, SlowBox(pushed))) counts.wrong++;
    }
  }
}

template <class T> void oneInstant(int count, const char* name) {
  int apart = 0, overlapping = 0;
  std::printf("  %s, %d pairs: errors as a share of the size\n", name, count);
  for (int f = 0; f < kFamilies; f++) {
    Random random(std::uint64_t(1000 + f));
    Counts counts;
    for (int k = 0; k < count / kFamilies; k++) {
      FamilyPair pair = randomPair(random, Family(f));
      // Every other pair within 1e-1 .. 1e-10 of its size from touching: there verdicts are hard.
      if (k % 2 && f != int(Family::nested) && f != int(Family::crossedEdges)) {
        double size = length(pair.motion.a.halfExtents) + length(pair.motion.b.halfExtents);
        double share = family_detail::powerOfTen(random, -10, -1);
        bringTogether(pair.motion, share * size * (random.below(2) ? 1 : -1));
      }
      lookAt<T>(pair, counts);
    }
    std::printf(
        "  %-15s %6d pairs, passed %6d; apart %6d (first by an edge row %5d), overlapping %6d; verdict differs %4d "
        "(at most %.1e), distance %.1e, depth %.1e\n",
        nameOf(Family(f)), counts.pairs, counts.pairs - counts.wrong, counts.apart, counts.byEdge, counts.overlapping,
        counts.borderline, counts.worstVerdict, counts.worstDistance, counts.worstDepth);
    EXPECT_EQ(counts.wrong, 0) << nameOf(Family(f));
    if (f != int(Family::nested)) {
      EXPECT_GE(counts.apart, counts.pairs / 10) << nameOf(Family(f));
    }
    EXPECT_GE(counts.overlapping, counts.pairs / 10) << nameOf(Family(f));
    if (f == int(Family::generic)) {
      EXPECT_GE(counts.byEdge, counts.pairs / 1000);
    }
    apart += counts.apart, overlapping += counts.overlapping;
  }
  EXPECT_GE(apart, count / 4);
  EXPECT_GE(overlapping, count / 4);
}

struct MotionCounts {
  int pairs = 0, hits = 0, misses = 0, overlapping = 0, wrong = 0, unique = 0, sets = 0, estimated = 0, byTable = 0;
  int grazing = 0, rows[3] = {0, 0, 0};
  double worstGap = 0, worstPoint = 0;
};

// Least distance over [0, until]: under constant velocity it is a convex function of time, so a golden section finds it.
double leastDistance(const ObbMotion& m, double until) {
  auto at = [&](double t) {
    Obb b = m.b;
    b.centre += m.velocityB * t;
    return slowDistance(SlowBox(m.a), SlowBox(b));
  };
  const double golden = 0.6180339887498949;
  double low = 0, high = until, p = high - golden * (high - low), q = low + golden * (high - low), dp = at(p),
         dq = at(q);
  for (int k = 0; k < 50 && dp > 0 && dq > 0; k++) {
    if (dp < dq) {
      high = q, q = p, dq = dp, p = high - golden * (high - low), dp = at(p);
    } else {
      low = p, p = q, dp = dq, q = low + golden * (high - low), dq = at(q);
    }
  }
  return std::min({dp, dq, at(0), at(until)});
}

double nearest(Vec3 p, const std::vector<Vec3>& set) {
  double best = std::numeric_limits<double>::infinity();
  for (Vec3 q : set) best = std::min(best, length(p - q));
  return best;
}

// The set of contact points of a hit: on both boxes, under a normal that separates them and, where all of the set is known, whole.
template <class T, class Wrong>
void lookAtContact(const ObbContactSetT<T>& contact, const SlowBox& slowA, const SlowBox& slowB, Family family,
                   double size, double slack, MotionCounts& counts, Wrong wrong) {
  counts.estimated += contact.estimated, counts.byTable += contact.byTable;
  (contact.unique ? counts.unique : counts.sets)++;
  double outside = 0;
  for (int k = 0; k < contact.count; k++) {
    Vec3 p = exactly(contact.points[std::size_t(k)].position);
    for (const SlowBox* s : {&slowA, &slowB}) {
      Vec3 local = abs(toLocal(s->box, p)) - s->box.halfExtents;
      outside = std::max({outside, local.x, local.y, local.z});
    }
  }
  counts.worstPoint = std::max(counts.worstPoint, outside / size);
  if (outside > 10 * slack) wrong("contact point outside");
  double high = 0, low = 0;
  Vec3 n = exactly(contact.normal);
  for (int k = 0; k < 3; k++) {
    high += std::fabs(dot(n, slowA.box.axes.row[k])) * slowA.box.halfExtents[k];
    low -= std::fabs(dot(n, slowB.box.axes.row[k])) * slowB.box.halfExtents[k];
  }
  low += dot(n, slowB.box.centre - slowA.box.centre);
  if (std::fabs(low - high) > 10 * slack) wrong("normal does not separate the boxes at contact");
  // Exactly level faces and edges, where all of the set is known.
  bool level = family == Family::aligned || family == Family::sharedNormal || family == Family::sharedEdge;
  if (level && std::is_same_v<T, double>) {
    std::vector<Vec3> slow = slowContact(slowA, slowB, 1e-9 * size), ours;
    for (int k = 0; k < contact.count; k++) ours.push_back(exactly(contact.points[std::size_t(k)].position));
    double apart = 0;
    for (Vec3 p : ours) apart = std::max(apart, nearest(p, slow));
    for (Vec3 p : slow) apart = std::max(apart, nearest(p, ours));
    if (apart > 1e-5 * size) wrong("contact set differs from corners and crossings");
  }
}

template <class T> void lookAtMotion(const FamilyPair& pair, Family family, MotionCounts& counts) {
  using Limit = Tolerances<T>;
  const ObbMotionT<T> motion = as<T>(pair.motion);
  ObbMotion exact;
  exact.a = exactBox(motion.a), exact.b = exactBox(motion.b), exact.velocityB = exactly(motion.velocityB);
  const double size = length(exact.a.halfExtents) + length(exact.b.halfExtents), speed = length(exact.velocityB);
  const double slack = Limit::time * size + centreRounding<T>(exact.a, exact.b);
  const double maxTime = 1.5;
  Result<ObbImpactT<T>> result = firstContact(motion, T(maxTime));
  ASSERT_TRUE(result) << result.error().message;
  counts.pairs++;
  const SlowBox slowA(exact.a);
  auto wrong = [&](const char* what) {
    if (counts.wrong++ < 3) ADD_FAILURE() << nameOf(family) << ": " << what << " pair " << counts.pairs;
  };
  if (result->hit == ObbHit::none) {
    counts.misses++;
    if (!(leastDistance(exact, maxTime) > 0)) {
      // A graze: it would have to miss by little, seen by making B smaller.
      ObbMotion smaller = exact;
      Vec3 less = smaller.b.halfExtents - Vec3{slack, slack, slack};
      smaller.b.halfExtents = max(less, Vec3{});
      counts.grazing++;
      if (leastDistance(smaller, maxTime - std::min(maxTime, slack / speed)) <= 0 && less.x > 0 && less.y > 0 &&
          less.z > 0) {
        wrong("a hit was missed");
      }
    }
    return;
  }
  if (result->hit == ObbHit::overlapping) {
    counts.overlapping++;
    if (slowDistance(slowA, SlowBox(exact.b)) > slack) wrong("not overlapping at the start");
    return;
  }
  counts.hits++;
  counts.rows[result->row < 3 ? 0 : result->row < 6 ? 1 : 2]++;
  auto boxAt = [&](double t) {
    Obb b = exact.b;
    b.centre += exact.velocityB * t;
    return b;
  };
  const double time = double(result->time);
  const SlowBox slowB(boxAt(time));
  double gap = slowDistance(slowA, slowB);
  counts.worstGap = std::max(counts.worstGap, gap / size);
  if (gap > slack) wrong("apart at the time of contact");
  // Before it they are apart: deep inside by then would have been seen.
  double before = std::max(0.0, time - 10 * slack / speed);
  if (-slowGap(slowA, SlowBox(boxAt(before))) > slack) wrong("touching before the time of contact");
  lookAtContact(result->contact, slowA, slowB, family, size, slack, counts, wrong);
}

template <class T> void firstContacts(int count, const char* name) {
  std::printf("  %s, %d moving pairs\n", name, count);
  for (int f = 0; f < kFamilies; f++) {
    Random random(std::uint64_t(2000 + f));
    MotionCounts counts;
    for (int k = 0; k < count / kFamilies; k++) lookAtMotion<T>(randomPair(random, Family(f)), Family(f), counts);
    std::printf(
        "  %-15s %6d pairs, passed %6d: %6d hits (rows of A %d, of B %d, edges %d; by table %d, unique %d, sets %d, "
        "estimated %d), %d misses (grazing %d), %d overlapping; gap at contact %.1e, point outside %.1e\n",
        nameOf(Family(f)), counts.pairs, counts.pairs - counts.wrong, counts.hits, counts.rows[0], counts.rows[1],
        counts.rows[2], counts.byTable, counts.unique, counts.sets, counts.estimated, counts.misses, counts.grazing,
        counts.overlapping, counts.worstGap, counts.worstPoint);
    EXPECT_EQ(counts.wrong, 0) << nameOf(Family(f));
    EXPECT_LE(counts.estimated, counts.hits / 1000) << nameOf(Family(f));
    if (f != int(Family::nested)) {
      EXPECT_GE(counts.hits, counts.pairs / 10) << nameOf(Family(f));
      // Crossed edges are aimed at each other.
      EXPECT_GE(counts.misses, f == int(Family::crossedEdges) ? 1 : counts.pairs / 100) << nameOf(Family(f));
    }
    if (f == int(Family::generic)) {
      EXPECT_GE(counts.rows[2], counts.hits / 4);
    }
    if (f == int(Family::aligned)) {
      EXPECT_GE(counts.sets, counts.hits / 2);
    }
  }
}

}  // namespace

void sweepOneInstant(int count) {
  oneInstant<double>(count, "double");
  oneInstant<float>(count, "float");
}
void sweepFirstContact(int count) {
  firstContacts<double>(count, "double");
  firstContacts<float>(count, "float");
}

}  // namespace brickfall::test
