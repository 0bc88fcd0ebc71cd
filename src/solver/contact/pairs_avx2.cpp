// Compiled with AVX2 where the compiler can (CMakeLists.txt), and called only where the machine has it: nothing here may leave a
// function behind that other files use, too. Hence lanes of their own type, and all else inlined always.
#include "math/wide_pair.h"
#include "solver/contact/pairs.h"
#include "solver/contact/pairs_kernel.h"

namespace brickfall {

#if defined(__AVX2__)
PairFunctions pairsInEight() { return kernel::pairFunctions<wide::Eight>(); }
#else
PairFunctions pairsInEight() { return {}; }
#endif

}  // namespace brickfall
