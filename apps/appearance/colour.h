// Colours as light: linear red, green, blue, 1 = all that falls on it. Files and screens have sRGB instead.
#pragma once
#include <cmath>
#include <cstdint>

#include "brickfall/math.h"

namespace brickfall::appearance {

using Vec3f = Vec3T<float>;
using Rgb = Vec3f;  // x red, y green, z blue

inline float clampUnit(float v) { return v < 0 ? 0 : v > 1 ? 1 : v; }
inline float mix(float a, float b, float share) { return a + (b - a) * share; }
inline Vec3f mix(Vec3f a, Vec3f b, float share) { return a + (b - a) * share; }
// 0 below `from`, 1 above `to`, smooth between.
inline float ramp(float from, float to, float v) {
  const float t = clampUnit((v - from) / (to - from));
  return t * t * (3 - 2 * t);
}
inline float brightness(Rgb c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

inline float linearFromSrgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }
inline float srgbFromLinear(float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }
inline Rgb linearFromHex(std::uint32_t rrggbb) {
  const auto part = [&](int shift) { return linearFromSrgb(float((rrggbb >> shift) & 0xff) / 255); };
  return {part(16), part(8), part(0)};
}
inline std::uint8_t toByte(float unit) { return std::uint8_t(clampUnit(unit) * 255 + 0.5f); }

}  // namespace brickfall::appearance
