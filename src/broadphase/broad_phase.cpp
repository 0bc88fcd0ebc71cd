// What all broad phases share.
#include "broadphase/broad_phase.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "broadphase/every_pair.h"
#include "broadphase/sweep_and_prune.h"
#include "broadphase/tree.h"

namespace brickfall {

std::string_view broadPhaseName(BroadPhaseMethod method) {
  constexpr std::string_view names[] = {"tree", "sweep_and_prune", "bounding_spheres", "all_pairs"};
  static_assert(std::size(names) == kBroadPhaseMethodCount);
  return names[std::size_t(method)];
}

std::unique_ptr<BroadPhase> makeBroadPhase(BroadPhaseMethod method) {
  switch (method) {
    case BroadPhaseMethod::sweepAndPrune:
      return std::make_unique<SweepAndPrune>();
    case BroadPhaseMethod::boundingSpheres:
      return std::make_unique<EveryPair>(true);
    case BroadPhaseMethod::allPairs:
      return std::make_unique<EveryPair>(false);
    case BroadPhaseMethod::tree:
      break;
  }
  return std::make_unique<BoxTree>();
}

bool mustMove(const Aabb& kept, const Aabb& tight, const Aabb& fresh) {
  auto edgeSum = [](const Aabb& box) {
    Vec3 d = box.upper - box.lower;
    return d.x + d.y + d.z;
  };
  return !(contains(kept, tight) && edgeSum(kept) <= 4 * edgeSum(fresh));
}

double rayEntry(const Aabb& box, Vec3 origin, Vec3 direction, double limit) {
  double enter = 0, leave = limit;
  for (int k = 0; k < 3; k++) {
    double low = box.lower[k] - origin[k], high = box.upper[k] - origin[k];
    if (std::fabs(direction[k]) < 1e-300) {
      if (low > 0 || high < 0) return std::numeric_limits<double>::infinity();
      continue;
    }
    double inv = 1 / direction[k], t0 = low * inv, t1 = high * inv;
    if (t0 > t1) std::swap(t0, t1);
    enter = std::max(enter, t0);
    leave = std::min(leave, t1);
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace brickfall
