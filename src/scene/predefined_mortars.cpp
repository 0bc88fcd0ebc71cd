// Typical values, recalled from the literature and not read again: fine to start from, no measured facts. Cement: the interface
// of the TU Eindhoven shear walls (Lourenco). Lime: a soft hydraulic lime, a fifth of that strength.
#include "brickfall/scene.h"

namespace brickfall {

const std::vector<MortarKind>& predefinedMortars() {
  static const std::vector<MortarKind> kinds = {
      {"lime", {0.05e6, 0.1e6, 0.7, 6, 40, 2e6, 30e9}, 1600},
      {"cement", {0.25e6, 0.35e6, 0.75, 18, 125, 10e6, 62e9}, 1900},
  };
  return kinds;
}

}  // namespace brickfall
