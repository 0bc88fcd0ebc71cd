// A picture while it is made: what light falls where, apart from the colour of what it falls on, so that noise can be taken out of
// the one without blurring the other.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "appearance/colour.h"

namespace brickfall::render {

using appearance::Rgb;
using appearance::Vec3f;

struct Texel {
  Rgb colour;          // of what is seen there: its share of reflected light
  Rgb sky;             // light from the sky and from other things, as it falls there: noisy
  Rgb direct;          // light that reaches the camera from the sun by way of one thing, mirrored light, the sky itself
  float variance = 0;  // of the brightness of `sky`, of the mean of all samples
  Vec3f normal;        // mean; short where several things meet
  float depth = 0;     // m, mean
  float covered = 0;   // share of samples that met something with `sky`
};

struct Picture {
  int width = 0, height = 0;
  std::vector<Texel> texels;  // rows from the top
  Texel& at(int x, int y) { return texels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  const Texel& at(int x, int y) const { return texels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

// What is written: 3 bytes a pixel, red green blue, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
};

}  // namespace brickfall::render
