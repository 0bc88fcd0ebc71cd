// The forces of a face's points at a motion, lane by lane.
#pragma once
#include "solver/face/kernel.h"

namespace brickfall {

struct PointForces {
  alignas(16) float n[4], t1[4], t2[4];  // N, on B
  alignas(16) float way[4];              // m, along the normal, of B against A
};

inline PointForces pointForcesAt(const FaceRecord& r, const SolveMotion* motion) {
  auto moved = kernel::pointMotion(r, kernel::frame(r), motion);
  auto f = kernel::pointForces(r, moved);
  PointForces out;
  kernel::store(f.n, out.n);
  kernel::store(f.t1, out.t1);
  kernel::store(f.t2, out.t2);
  kernel::store(moved.n, out.way);
  return out;
}

}  // namespace brickfall
