#include "solver/face/pairs.h"

#include "math/wide_pair.h"
#include "solver/face/pairs_kernel.h"

namespace brickfall {

namespace {

PairFunctions choose() {
#if defined(__x86_64__)
  PairFunctions eight = pairsInEight();
  if (eight.sum && __builtin_cpu_supports("avx2")) return eight;
#endif
  return pairsInHalves();
}
const PairFunctions& chosen() {
  static const PairFunctions functions = choose();
  return functions;
}

}  // namespace

PairFunctions pairsInHalves() { return kernel::pairFunctions<wide::Halves>(); }

void sumFaces(const Boundary& boundary, const FaceRecord* records, BoundarySums& sums) {
  (sums.matrix ? chosen().sumWithMatrix : chosen().sum)(boundary, records, sums);
}

void readFaces(const FaceRecord* records, std::size_t count, const SolveMotion* motion, Reading* out) {
  chosen().read(records, count, motion, out);
}

void readStiffFaces(const FaceRecord* records, const std::uint32_t* faces, std::size_t count, const SolveMotion* motion,
                    Resist how, StiffReaction* out) {
  chosen().readStiff(records, faces, count, motion, how, out);
}

}  // namespace brickfall
