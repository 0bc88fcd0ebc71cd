// The forces of a face's points at a motion, lane by lane.
#pragma once
#include "solver/face/kernel.h"

namespace brickfall {

// m, of B against A: along the normal and the tangents.
struct PointWays {
  alignas(16) float way[4], way1[4], way2[4];
};
struct PointForces : PointWays {
  alignas(16) float n[4], t1[4], t2[4];  // N, on B
  alignas(16) float trialN[4];           // N, what the normal force would be without its least
  std::uint32_t slides = 0;              // bit per point outside the friction cone
};

inline void writeWays(const kernel::PointMotion<wide::V>& moved, PointWays& out) {
  kernel::store(moved.n, out.way);
  kernel::store(moved.t1, out.way1);
  kernel::store(moved.t2, out.way2);
}
inline PointWays pointWaysAt(const FaceRecord& r, const SolveMotion* motion) {
  PointWays out;
  writeWays(kernel::pointMotion(r, kernel::frame(r), motion), out);
  return out;
}
inline PointForces pointForcesAt(const FaceRecord& r, const SolveMotion* motion) {
  auto moved = kernel::pointMotion(r, kernel::frame(r), motion);
  auto f = kernel::pointForces(r, moved);
  PointForces out;
  writeWays(moved, out);
  kernel::store(f.n, out.n);
  kernel::store(f.t1, out.t1);
  kernel::store(f.t2, out.t2);
  kernel::store(f.trialN, out.trialN);
  out.slides = wide::bits(f.slides);
  return out;
}

}  // namespace brickfall
