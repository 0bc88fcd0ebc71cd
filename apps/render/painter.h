// One picture of a take: from poses to pixels.
#pragma once
#include <span>

#include "render/dust.h"
#include "render/picture.h"
#include "render/sky.h"
#include "render/stage.h"
#include "render/tracer.h"

namespace brickfall::render {

struct PaintSettings {
  int width = 960, height = 540;
  TraceSettings trace;
  bool denoise = true;
  float exposure = appearance::usualExposure();
};

// The bodies are where `stage` has them.
Image paint(const Stage& stage, const Camera& open, const Camera& close, const Sky& sky, const PaintSettings& settings,
            std::span<const Puff> dust = {});

}  // namespace brickfall::render
