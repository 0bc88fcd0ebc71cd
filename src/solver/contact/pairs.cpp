#include "solver/contact/pairs.h"

#include "math/wide_pair.h"
#include "solver/contact/pairs_kernel.h"

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

void sumContacts(const Boundary& boundary, const ContactRecord* records, BoundarySums& sums) {
  (sums.matrix ? chosen().sumWithMatrix : chosen().sum)(boundary, records, sums);
}

void readContacts(const ContactRecord* records, std::size_t count, const SolveMotion* motion, Reading* out) {
  chosen().read(records, count, motion, out);
}

}  // namespace brickfall
