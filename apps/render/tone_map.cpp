#include "render/tone_map.h"

#include <algorithm>
#include <cmath>

#include "appearance/light.h"

namespace brickfall::render {

using appearance::Rgb;

namespace {

// The curve of sRGB as a table over the root of light, so that its steep start has steps enough.
class SrgbTable {
 public:
  SrgbTable() {
    for (int k = 0; k <= kSteps; k++) {
      const float root = float(k) / kSteps;
      table_[k] = 255 * appearance::srgbFromLinear(root * root);
    }
  }
  float at(float light) const {
    const float place = std::sqrt(appearance::clampUnit(light)) * kSteps;
    const int k = std::min(int(place), kSteps - 1);
    return appearance::mix(table_[k], table_[k + 1], place - float(k));
  }

 private:
  static constexpr int kSteps = 4096;
  float table_[kSteps + 1];
};
const SrgbTable kSrgb;

}  // namespace

std::array<std::uint8_t, 3> pixelOf(Rgb light, float exposure, float dither) {
  const Rgb shown = appearance::toneMapped(light, exposure);
  std::array<std::uint8_t, 3> out;
  for (int k = 0; k < 3; k++) {
    out[std::size_t(k)] = std::uint8_t(std::min(kSrgb.at(shown[k]) + dither, 255.0f));
  }
  return out;
}

}  // namespace brickfall::render
