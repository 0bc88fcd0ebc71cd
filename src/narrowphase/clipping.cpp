// Reduction of a contact polygon to the largest quadrilateral of its corners that has the deepest one.
#include "narrowphase/clipping.h"

namespace brickfall {
namespace {

int mergeEqual(PatchPoint* points, int count, const ContactTolerances& tolerances) {
  double same2 = tolerances.same * tolerances.same;
  int kept = 0;
  for (int i = 0; i < count; i++) {
    int twin = -1;
    for (int k = 0; k < kept && twin < 0; k++) {
      double du = points[k].u - points[i].u, dv = points[k].v - points[i].v,
             ds = points[k].separation - points[i].separation;
      if (du * du + dv * dv + ds * ds < same2) twin = k;
    }
    if (twin < 0)
      points[kept++] = points[i];
    else if (points[i].separation < points[twin].separation - tolerances.slack)
      points[twin] = points[i];
  }
  return kept;
}

// Twice the area of three corners.
double area(const PatchPoint& p, const PatchPoint& q, const PatchPoint& r) {
  return std::fabs((q.u - p.u) * (r.v - p.v) - (q.v - p.v) * (r.u - p.u));
}

// Tries each corner as the one opposite to the deepest; the best on either side of that diagonal do not depend on each
// other. Of equal choices the first around from the deepest.
void keepLargest(PatchPoint* points, int count, int deepest) {
  constexpr double kClearly = 1 + 1e-6;
  auto at = [&](int k) -> const PatchPoint& { return points[deepest + k < count ? deepest + k : deepest + k - count]; };
  double best = -1;
  int chosen[3] = {1, 2, 3};  // steps from the deepest
  for (int opposite = 2; opposite < count - 1; opposite++) {
    double left = -1, right = -1;
    int l = 1, r = opposite + 1;
    for (int k = 1; k < opposite; k++)
      if (double x = area(at(0), at(k), at(opposite)); x > left * kClearly) left = x, l = k;
    for (int k = opposite + 1; k < count; k++)
      if (double x = area(at(0), at(opposite), at(k)); x > right * kClearly) right = x, r = k;
    if (left + right > best * kClearly) {
      best = left + right;
      chosen[0] = l, chosen[1] = opposite, chosen[2] = r;
    }
  }
  PatchPoint kept[kMaxManifoldPoints] = {at(0), at(chosen[0]), at(chosen[1]), at(chosen[2])};
  for (int i = 0; i < kMaxManifoldPoints; i++) points[i] = kept[i];
}

}  // namespace

int reducePatch(PatchPoint* points, int count, const ContactTolerances& tolerances) {
  count = mergeEqual(points, count, tolerances);
  if (count <= kMaxManifoldPoints) return count;
  int deepest = 0;
  double least = points[0].separation;
  for (int i = 1; i < count; i++) least = points[i].separation < least ? points[i].separation : least;
  while (points[deepest].separation > least + tolerances.slack) deepest++;
  keepLargest(points, count, deepest);
  return kMaxManifoldPoints;
}

}  // namespace brickfall
