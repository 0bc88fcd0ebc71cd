// The light that reaches each pixel: from the camera to what is seen, from there to the sun and on into the scene, as often as asked
// for (path tracing).
#pragma once
#include <functional>

#include "render/camera_rays.h"
#include "render/picture.h"
#include "render/sky.h"

namespace brickfall::render {

struct TraceSettings {
  // Of a pixel; half of them where one thing at rest is seen, twice as many at the edge of a shadow, four times where something moves.
  int samples = 4;
  int bounces = 1;  // how often light is followed on from what is seen; after that the sky's mean stands for the rest
  int threads = 1;
  std::function<bool()> stop;  // asked now and then: true leaves the picture unfinished
};

Picture trace(const Stage& stage, const CameraRays& rays, const Sky& sky, int width, int height,
              const TraceSettings& settings);

}  // namespace brickfall::render
