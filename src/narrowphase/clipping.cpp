// Reduction of a contact polygon to four of its corners: those that carry already, and what a body would tip onto.
#include "narrowphase/clipping.h"

namespace brickfall {
namespace {

int mergeEqual(PatchPoint* points, int count, const ContactTolerances& tolerances, const LoadedPoints& loaded) {
  double same2 = tolerances.same * tolerances.same;
  int kept = 0;
  for (int i = 0; i < count; i++) {
    int twin = -1;
    for (int k = 0; k < kept && twin < 0; k++) {
      double du = points[k].u - points[i].u, dv = points[k].v - points[i].v,
             ds = points[k].separation - points[i].separation;
      if (du * du + dv * dv + ds * ds < same2) twin = k;
    }
    if (twin < 0) {
      points[kept++] = points[i];
      continue;
    }
    const bool carries = loaded.has(points[i].feature), twinCarries = loaded.has(points[twin].feature);
    const bool deeper = points[i].separation < points[twin].separation - tolerances.slack;
    if (carries == twinCarries ? deeper : carries) points[twin] = points[i];
  }
  return kept;
}

// Which corners of a polygon are kept: four in the end, whatever else is asked for.
class Selection {
 public:
  Selection(PatchPoint* points, int count) : points_(points), count_(count) {}

  bool isFull() const { return chosen_ == kMaxManifoldPoints; }
  void keep(int i) {
    if (isFull() || kept_[i]) return;
    kept_[i] = true;
    chosen_++;
  }
  // The corner that adds most to the area of those kept; of equal ones the first on the way round from `start`.
  void keepFarthest(int start) {
    constexpr double kClearly = 1 + 1e-6;
    double most = -1;
    int best = -1;
    for (int k = 1; k < count_; k++) {
      const int i = (start + k) % count_;
      if (kept_[i]) continue;
      const double gain = gainOf(i);
      if (gain > most * kClearly) most = gain, best = i;
    }
    keep(best);
  }
  void moveToFront() {
    for (int i = 0, to = 0; i < count_; i++)
      if (kept_[i]) points_[to++] = points_[i];
  }

 private:
  // Twice the triangle with its neighbours among those kept; of a single one, which is both, the distance squared.
  double gainOf(int i) const {
    int before = i, after = i;
    while (!kept_[before]) before = before > 0 ? before - 1 : count_ - 1;
    while (!kept_[after]) after = after + 1 < count_ ? after + 1 : 0;
    const PatchPoint &p = points_[before], &q = points_[after], &r = points_[i];
    const double pu = p.u - r.u, pv = p.v - r.v, qu = q.u - r.u, qv = q.v - r.v;
    return before == after ? pu * pu + pv * pv : std::fabs(pu * qv - pv * qu);
  }

  PatchPoint* points_;
  int count_, chosen_ = 0;
  bool kept_[kMaxPatchPoints] = {};
};

}  // namespace

ReducedPatch reducePatch(PatchPoint* points, int count, const ContactTolerances& tolerances,
                         const LoadedPoints& loaded) {
  count = mergeEqual(points, count, tolerances, loaded);
  if (count <= kMaxManifoldPoints) return {count, false};
  Selection selection(points, count);
  for (int i = 0; i < count; i++)
    if (loaded.has(points[i].feature)) selection.keep(i);
  int deepest = 0;
  for (int i = 1; i < count; i++)
    if (points[i].separation < points[deepest].separation) deepest = i;
  selection.keep(deepest);
  while (!selection.isFull()) selection.keepFarthest(deepest);
  selection.moveToFront();
  return {kMaxManifoldPoints, true};
}

}  // namespace brickfall
