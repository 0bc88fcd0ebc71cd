// Compiled with AVX2 where the compiler can (CMakeLists.txt), and called only where the machine has it. Nothing here
// may leave a function behind that other files use, too. Hence the lanes have their own type, and all else is always
// inlined.
#include "math/wide_pair.h"
#include "solver/block_sweeps_kernel.h"
#include "solver/face/pairs.h"
#include "solver/face/pairs_kernel.h"

namespace brickfall {

#if defined(__AVX2__)
PairFunctions pairsInEight() { return kernel::pairFunctions<wide::Eight>(); }
SweepFunctions sweepsInEight() { return blocks::sweepFunctions<wide::Eight>(); }
#else
PairFunctions pairsInEight() { return {}; }
SweepFunctions sweepsInEight() { return {}; }
#endif

}  // namespace brickfall
