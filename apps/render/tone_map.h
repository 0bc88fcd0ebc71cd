// From light to what a screen shows: bright parts are pressed together instead of cut off, and lose colour as film does.
#pragma once
#include <array>
#include <cstdint>

#include "appearance/colour.h"

namespace brickfall::render {

// 0 stays 0, all light stays below 1 and rises with what comes in; `exposure` is a factor.
appearance::Rgb toneMapped(appearance::Rgb light, float exposure);
// sRGB. `dither` (0 .. 1, by pixel) hides the steps of 8 bits in the sky.
std::array<std::uint8_t, 3> pixelOf(appearance::Rgb light, float exposure, float dither);

}  // namespace brickfall::render
