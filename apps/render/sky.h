// The light outdoors on a day with thin haze, by a formula of our own with few numbers (docs/render.md): a sky that is brightest
// at the horizon and around the sun, and a sun that is a disc with soft shadows.
#pragma once
#include "appearance/colour.h"

namespace brickfall::render {

using appearance::Rgb;
using appearance::Vec3f;

struct Sky {
  Vec3f sun{0.5f, 0.7f, 0.5f};     // unit, towards it
  Rgb sunLight{4.6f, 4.0f, 3.2f};  // irradiance of a surface that faces it
  float sunRadius = 0.011f;        // rad; the real one's is 0.0047: some haze

  // Radiance from a direction (unit) without the sun's disc. From below the horizon: what bare ground sends back.
  Rgb radiance(Vec3f direction) const;
  // Mean over the upper half: the light of a place under open sky from all sides, for where nothing is traced any more.
  Rgb mean() const;
};

// Azimuth from +z towards +x, elevation above the horizon, degrees.
Vec3f sunDirection(double azimuthDegrees, double elevationDegrees);

}  // namespace brickfall::render
