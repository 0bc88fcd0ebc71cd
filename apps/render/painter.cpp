#include "render/painter.h"

#include "render/denoise.h"
#include "render/parallel.h"
#include "render/sampler.h"
#include "render/tone_map.h"

namespace brickfall::render {

Image paint(const Stage& stage, const Camera& open, const Camera& close, const Sky& sky, const PaintSettings& settings,
            std::span<const Puff> dust) {
  const CameraRays rays(open, close, settings.width, settings.height);
  Picture picture = trace(stage, rays, sky, settings.width, settings.height, settings.trace);
  if (settings.denoise) denoise(picture, rays, settings.trace.threads);
  std::vector<Rgb> light = developed(picture);
  addDust(light, picture, viewOf(open), dust, settings.trace.threads);
  Image image{settings.width, settings.height, std::vector<std::uint8_t>(3 * light.size())};
  forRows(settings.height, settings.trace.threads, [&](int y) {
    for (int x = 0; x < settings.width; x++) {
      const std::size_t at = std::size_t(y) * std::size_t(settings.width) + std::size_t(x);
      const auto pixel = pixelOf(light[at], settings.exposure, Sampler(x, y, 1, 1).pair(0, 0).x);
      std::copy(pixel.begin(), pixel.end(), image.bytes.begin() + std::ptrdiff_t(3 * at));
    }
  });
  return image;
}

}  // namespace brickfall::render
