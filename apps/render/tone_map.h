// From light to the bytes of a picture (appearance/light.h has the curve).
#pragma once
#include <array>
#include <cstdint>

#include "appearance/colour.h"

namespace brickfall::render {

// sRGB. `dither` (0 .. 1, by pixel) hides the steps of 8 bits in the sky.
std::array<std::uint8_t, 3> pixelOf(appearance::Rgb light, float exposure, float dither);

}  // namespace brickfall::render
