// The light that reaches each pixel (path tracing): from the camera to the surface that is seen, from there to the sun and
// on into the scene, as often as asked for.
#pragma once
#include <functional>

#include "render/camera_rays.h"
#include "render/picture.h"
#include "render/sky.h"

namespace brickfall::render {

struct TraceSettings {
  // Rays of a pixel. A pixel that sees one thing at rest takes half of them, at the edge of a shadow twice as many, where
  // something moves four times as many.
  int samples = 4;
  int bounces = 1;  // how often light is followed on from the first surface; then the sky's mean stands for the rest
  int threads = 1;
  std::function<bool()> stop;  // asked now and then: true leaves the picture unfinished
};

Picture trace(const Stage& stage, const CameraRays& rays, const Sky& sky, int width, int height,
              const TraceSettings& settings);

}  // namespace brickfall::render
