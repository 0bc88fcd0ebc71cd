// Locked axes in the solve (dynamics/axis_locks.h). Along them a body's unknowns stay 0: their residual is the world's
// to bear, and counts as none; the matrix has nothing but a diagonal there. A rigid cluster keeps the locks of all its
// bodies: where a way of one is locked, no turn may carry it along that way.
#pragma once
#include "dynamics/axis_locks.h"
#include "solver/island.h"
#include "solver/symmetric6.h"

namespace brickfall {

inline bool anyLocks(const Island& island) { return !island.locks.empty(); }

inline void keepFree(Wrench& w, std::uint8_t locks) {
  w.force = without(w.force, locks & kAllWays);
  w.torque = without(w.torque, locks >> 3);
}
// To be called wherever residuals were changed.
inline void keepFree(Island& island) {
  for (std::size_t i = 0; i < island.locks.size(); i++) keepFree(island.residual[i], island.locks[i]);
}
inline void keepFree(Island& island, RowEnds ends) {
  for (std::uint32_t body : {ends.a, ends.b})
    if (body < island.locks.size()) keepFree(island.residual[body], island.locks[body]);
}

inline std::uint8_t locksOf(const Island& island, const Level& level, const Cluster& cluster) {
  std::uint8_t all = 0;
  if (!anyLocks(island)) return all;
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) all |= island.locks[level.bodies[k]];
  if (cluster.bodyEnd - cluster.bodyBegin == 1) return all;
  if (all & 1) all |= 16 | 32;
  if (all & 2) all |= 8 | 32;
  if (all & 4) all |= 8 | 16;
  return all;
}

inline void lockAxes(Symmetric6& matrix, std::uint8_t locks) {
  for (int k = 0; k < 6; k++) {
    if (!(locks >> k & 1)) continue;
    for (int i = 0; i < 6; i++)
      if (i != k) matrix.at(std::max(i, k), std::min(i, k)) = 0;
  }
}

//! x the entry that is there | too small: others feel what is locked | too large: floats round
constexpr float kLockedStiffness = 1e4f;  // of a locked unknown in a matrix of many bodies; its step is then left out

}  // namespace brickfall
