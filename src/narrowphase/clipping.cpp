// Reduction of a contact polygon. Dropping the corner that costs the least area, again and again (Visvalingam's line
// simplification), leaves a rectangle of its four corners whatever is cut off from them, and depends on the order of the
// corners only where areas tie.
#include "narrowphase/clipping.h"

namespace brickfall {
namespace {

int mergeEqual(PatchPoint* points, int count, const ContactTolerances& tolerances) {
  double same2 = tolerances.same * tolerances.same;
  int kept = 0;
  for (int i = 0; i < count; i++) {
    int twin = -1;
    for (int k = 0; k < kept && twin < 0; k++) {
      double du = points[k].u - points[i].u, dv = points[k].v - points[i].v, ds = points[k].separation - points[i].separation;
      if (du * du + dv * dv + ds * ds < same2) twin = k;
    }
    if (twin < 0)
      points[kept++] = points[i];
    else if (points[i].separation < points[twin].separation - tolerances.slack)
      points[twin] = points[i];
  }
  return kept;
}

}  // namespace

int reducePatch(PatchPoint* points, int count, const ContactTolerances& tolerances) {
  count = mergeEqual(points, count, tolerances);
  if (count <= kMaxManifoldPoints) return count;
  int deepest = 0;
  double least = points[0].separation;
  for (int i = 1; i < count; i++) least = points[i].separation < least ? points[i].separation : least;
  while (points[deepest].separation > least + tolerances.slack) deepest++;
  while (count > kMaxManifoldPoints) {
    int drop = -1;
    double leastArea = 0;
    for (int i = 0; i < count; i++) {
      if (i == deepest) continue;
      const PatchPoint& p = points[i == 0 ? count - 1 : i - 1];
      const PatchPoint& q = points[i];
      const PatchPoint& r = points[i + 1 == count ? 0 : i + 1];
      double area = std::fabs((q.u - p.u) * (r.v - p.v) - (q.v - p.v) * (r.u - p.u));
      if (drop < 0 || area < leastArea * (1 - 1e-6)) {
        drop = i;
        leastArea = area;
      }
    }
    for (int i = drop; i + 1 < count; i++) points[i] = points[i + 1];
    if (drop < deepest) deepest--;
    count--;
  }
  return count;
}

}  // namespace brickfall
