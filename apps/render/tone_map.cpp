#include "render/tone_map.h"

#include <algorithm>
#include <cmath>

namespace brickfall::render {

using appearance::Rgb;

namespace {

constexpr float kShoulder = 0.62f;  // up to here as it is; lower: softer highlights, a greyer picture

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

// Straight up to the shoulder, then towards 1 without ever reaching it.
float curve(float v) {
  if (v <= kShoulder) return v;
  const float over = (v - kShoulder) / (1 - kShoulder);
  return kShoulder + (1 - kShoulder) * (over / (1 + over));
}

}  // namespace

Rgb toneMapped(Rgb light, float exposure) {
  const Rgb in = max(light * exposure, Rgb{});
  // Half by each colour for itself (which bleaches), half by the brightest (which keeps the hue).
  const float peak = std::max({in.x, in.y, in.z, 1e-6f});
  const Rgb kept = in * (curve(peak) / peak);
  return (Rgb{curve(in.x), curve(in.y), curve(in.z)} + kept) * 0.5f;
}

std::array<std::uint8_t, 3> pixelOf(Rgb light, float exposure, float dither) {
  const Rgb shown = toneMapped(light, exposure);
  std::array<std::uint8_t, 3> out;
  for (int k = 0; k < 3; k++) {
    out[std::size_t(k)] = std::uint8_t(std::min(kSrgb.at(shown[k]) + dither, 255.0f));
  }
  return out;
}

}  // namespace brickfall::render
