#include "render/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brickfall::render {

namespace {

constexpr Rgb kZenith{0.34f, 0.53f, 0.85f}, kHorizon{0.90f, 0.94f, 0.97f}, kBelow{0.46f, 0.45f, 0.43f};
constexpr Rgb kGlow{1.0f, 0.90f, 0.74f};

}  // namespace

Rgb Sky::radiance(Vec3f d) const {
  // The air is thicker towards the horizon: its share of white rises with the way through it.
  const float up = std::max(d.y, 0.0f), clear = 1 - up, haze = clear * clear * clear;
  Rgb light = appearance::mix(kZenith, kHorizon, haze);
  // Around the sun: a wide glow and a narrow one.
  const float towards = std::max(dot(d, sun), 0.0f), t2 = towards * towards, t4 = t2 * t2, t8 = t4 * t4;
  const float t32 = t8 * t8 * t8 * t8;
  light += kGlow * (0.25f * t8 + 0.9f * t32 * t32);
  if (d.y >= 0) return light;
  return appearance::mix(light, kBelow, appearance::ramp(0, 0.12f, -d.y));
}

Rgb Sky::mean() const {
  // A few directions, evenly by their share of what falls on the ground.
  Rgb sum;
  constexpr int kRings = 4, kSectors = 8;
  for (int ring = 0; ring < kRings; ring++)
    for (int sector = 0; sector < kSectors; sector++) {
      const float flat = std::sqrt((float(ring) + 0.5f) / kRings), up = std::sqrt(1 - flat * flat);
      const float angle = 2 * std::numbers::pi_v<float> * (float(sector) + 0.5f) / kSectors;
      sum += radiance({flat * std::cos(angle), up, flat * std::sin(angle)});
    }
  return sum * (1.0f / (kRings * kSectors));
}

Vec3f sunDirection(double azimuthDegrees, double elevationDegrees) {
  const double azimuth = azimuthDegrees * std::numbers::pi / 180, elevation = elevationDegrees * std::numbers::pi / 180;
  return {float(std::cos(elevation) * std::sin(azimuth)), float(std::sin(elevation)),
          float(std::cos(elevation) * std::cos(azimuth))};
}

}  // namespace brickfall::render
