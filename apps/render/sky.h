// The light outdoors on a day with thin haze (appearance/light.h), with a sun that is a disc, for soft shadows.
#pragma once
#include "appearance/light.h"

namespace brickfall::render {

using appearance::Rgb;
using appearance::Vec3f;

struct Sky {
  Vec3f sun{0.5f, 0.7f, 0.5f};  // unit, towards it
  Rgb sunLight = appearance::sunLight();
  float sunRadius = 0.011f;  // rad; the real one's is 0.0047: some haze

  Rgb radiance(Vec3f direction) const { return appearance::skyLight(direction, sun); }
  // Mean over the upper half: the light of a place under open sky from all sides, for where nothing is traced any more.
  Rgb mean() const;
};

}  // namespace brickfall::render
