#include "solver/joint_energy.h"

#include <algorithm>

#include "solver/contact_kernel.h"

namespace brickfall {

namespace {

static_assert(kCorrect == 0.5f && kHeldShare == 0.5f, "the energy is that of this law");

double springEnergy(double stiffness, double way, double held) {
  double decaying = held + stiffness * way;
  return 0.5 * stiffness * way * way + decaying * decaying / (6 * stiffness);
}

}  // namespace

double elasticEnergy(const Contact& c, const StepContext& context) {
  double full = context.settings.restingStiffness * c.effectiveMass / (context.dt * context.dt);
  double cap = kHeldWeights * kReferenceGravity * c.effectiveMass;
  double sum = 0;
  for (int i = 0; i < c.count; i++) {
    double gap = double(c.gap[i]) - double(c.offset[i]), k = c.stiffness[i];
    if (!(k > 0) || (gap >= 0 && c.heldN[i] == 0)) continue;
    if (k < 0.99 * full) {
      double share = c.forceN[i] > cap ? cap / c.forceN[i] : 1;
      auto left = [&](double force) { return 0.5 * force * force * share * share / full; };
      sum += left(c.forceN[i]) + left(c.force1[i]) + left(c.force2[i]);
      continue;
    }
    sum += springEnergy(k, gap, c.heldN[i]);
    // What slid is placed so that its spring carries the sliding force; what opened lets go of its anchor.
    bool sticks = c.stickingMask >> i & 1;
    if (!sticks && c.forceN[i] == 0) continue;
    sum += springEnergy(k, sticks ? c.drift1[i] : c.slip1[i], c.held1[i]);
    sum += springEnergy(k, sticks ? c.drift2[i] : c.slip2[i], c.held2[i]);
  }
  return sum;
}

JointWork jointWork(const Island& island, const StepContext& context) {
  JointWork out;
  for (std::size_t n = 0; n < island.records.size(); n++) {
    Contact c = context.contacts->contacts[island.contacts[n]];  // as if it held all of its force
    kernel::PointMotion m =
        kernel::pointMotion(island.records[n], kernel::frame(island.records[n]), island.motion.data());
    alignas(16) float way[3][4];
    kernel::store(m.n, way[0]);
    kernel::store(m.t1, way[1]);
    kernel::store(m.t2, way[2]);
    for (int i = 0; i < c.count; i++) {
      out.work += double(c.forceN[i]) * double(way[0][i]) + double(c.force1[i]) * double(way[1][i]) +
                  double(c.force2[i]) * double(way[2][i]);
      c.gap[i] += way[0][i];
      c.drift1[i] += way[1][i];
      c.drift2[i] += way[2][i];
    }
    std::copy(c.forceN, c.forceN + 4, c.heldN);
    std::copy(c.force1, c.force1 + 4, c.held1);
    std::copy(c.force2, c.force2 + 4, c.held2);
    out.elastic += elasticEnergy(c, context);
  }
  return out;
}

}  // namespace brickfall
