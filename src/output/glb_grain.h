// The grain of bricks, concrete and mortar: one small picture for a glTF file, lighter and darker about the material's colour.
#pragma once
#include "record/byte_stream.h"

namespace brickfall {

//! not of the method: the picture's
constexpr double kGrainMean = 0.86;  // of the light: a material's colour is over it, so that the mean stays as it is

// A PNG that repeats without a seam, the same bytes every time.
Bytes grainPicture();

}  // namespace brickfall
