// Noise in space from a hash of whole numbers: the same everywhere, without tables. A pattern that is finer than what is looked at
// (the footprint: the width of a pixel on the surface) fades to its mean, so that it neither flickers nor costs time.
#pragma once
#include <cstdint>

#include "appearance/colour.h"

namespace brickfall::appearance {

inline std::uint32_t hashOf(std::uint64_t key) {
  key ^= key >> 31;
  key *= 0x9e3779b97f4a7c15ull;
  key ^= key >> 29;
  key *= 0xbf58476d1ce4e5b9ull;
  return std::uint32_t(key >> 32);
}
// 0 .. 1, fixed for each pair. The page's script has the same (colours.ts): bricks differ alike in all pictures.
inline float chance(std::uint32_t number, std::uint32_t salt) {
  std::uint32_t h = number * 374761393u + salt * 668265263u;
  h = (h ^ h >> 13) * 1274126177u;
  return float((h ^ h >> 16) >> 8) * 0x1p-24f;
}

// -1 .. 1, smooth; one bump a unit of length.
float valueNoise(Vec3f p, std::uint32_t seed);

// How much of a pattern of this wavelength is still seen: 1 from three footprints on, none at one.
inline float seenShare(float wavelength, float footprint) {
  if (footprint <= 0) return 1;
  return clampUnit(0.5f * (wavelength / footprint) - 0.5f);
}
// -1 .. 1 with bumps of a wavelength (m), faded by the footprint.
inline float grain(Vec3f p, float wavelength, std::uint32_t seed, float footprint) {
  const float seen = seenShare(wavelength, footprint);
  return seen > 0 ? seen * valueNoise(p * (1 / wavelength), seed) : 0;
}

}  // namespace brickfall::appearance
