// What floats round of the forces of firm rows. These are so firm that the last bits of their bodies' ways are a force:
// it counts as balance, or no solve of fast bodies would end.
#pragma once
#include <algorithm>
#include <span>

#include "solver/imbalance.h"
#include "solver/reaction.h"
#include "solver/solve_body.h"

namespace brickfall {

// On a body. A thin rod's is a torque at the ends of its arms, however little its inner radius.
struct Rounding {
  double force = 0, torque = 0;  // N, N m
};

// N/m, or N m/rad. Of a line: firm along it alone, whichever way it hangs.
inline double firmestOf(const wide::V (&stiffness)[3]) {
  return double(std::max({stiffness[0][0], stiffness[1][1], stiffness[2][2]}));
}

// A row's ends go where their bodies go and turn; both make its force. Their turns make its torque.
inline void addRounding(std::span<Rounding> rounding, RowEnds ends, const StiffReaction& x, const SolveMotion* motion) {
  struct End {
    std::uint32_t body;
    double arm;
  } both[2] = {{ends.a, double(length(wide::store3(x.armA)))}, {ends.b, double(length(wide::store3(x.armB)))}};
  double reach = 0, turn = 0;
  for (const End& end : both) {
    if (end.body >= rounding.size()) continue;
    const double turned = double(length(motion[end.body].th));
    turn = std::max(turn, turned);
    reach = std::max(reach, double(length(motion[end.body].d)) + turned * end.arm);
  }
  const double force = kLastBit * firmestOf(x.stiffness.A) * reach, torque = kLastBit * firmestOf(x.stiffness.C) * turn;
  for (const End& end : both) {
    if (end.body >= rounding.size()) continue;
    rounding[end.body].force += force;
    rounding[end.body].torque += force * end.arm + torque;
  }
}

// Residual over what counts as balance: so much of the measure, and what floats round.
inline double over(const Wrench& residual, const Measure& measure, double share, const Rounding& rounding) {
  double out = 0;
  takeLarger(out, double(length(residual.force)) / (share * measure.force + rounding.force));
  takeLarger(out, double(length(residual.torque)) / (share * measure.force * measure.arm + rounding.torque));
  return out;
}

}  // namespace brickfall
