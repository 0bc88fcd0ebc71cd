// Typical values, recalled from the literature and not read again: fine to start from, no measured facts. Cement: the interface
// of the TU Eindhoven shear walls (Lourenco). Lime: a soft hydraulic lime, a fifth of that strength.
#include "brickfall/scene.h"

namespace brickfall {

const std::vector<MortarKind>& predefinedMortars() {
  static const std::vector<MortarKind> kinds = {
      {"lime", {0.05e6, 0.1e6, 0.7, 6, 40, 2e6, 3.2e3, 30e9}, 1600},
      {"cement", {0.25e6, 0.35e6, 0.75, 18, 125, 10e6, 16e3, 62e9}, 1900},
  };
  return kinds;
}

// Formats are those of BS EN 771-1 work sizes and of the AS 3700 calculators; hollows are typical ones, recalled: a frog of 8 % of
// the brick, three holes of 17 %, ten of 18 %.
const std::vector<BrickKind>& predefinedBricks() {
  static const Vec3 uk{0.215, 0.065, 0.1025}, as3700{0.230, 0.076, 0.110};
  static const std::vector<BrickKind> kinds = {
      {"uk", {uk, {}, {}}, "brick"},
      {"uk_frogged", {uk, {0.15, 0.06, 0.12, 0.035, 0.018}, {}}, "brick"},
      {"uk_perforated", {uk, {}, {3, 1, 0.02}}, "brick"},
      {"as3700", {as3700, {}, {}}, "brick"},
      {"as3700_perforated", {as3700, {}, {5, 2, 0.012}}, "brick"},
  };
  return kinds;
}

}  // namespace brickfall
