#include "render/sky.h"

#include <cmath>
#include <numbers>

namespace brickfall::render {

Rgb Sky::mean() const {
  // A few directions, evenly by their share of what falls on the ground.
  Rgb sum;
  constexpr int kRings = 4, kSectors = 8;
  for (int ring = 0; ring < kRings; ring++)
    for (int sector = 0; sector < kSectors; sector++) {
      const float flat = std::sqrt((float(ring) + 0.5f) / kRings), up = std::sqrt(1 - flat * flat);
      const float angle = 2 * std::numbers::pi_v<float> * (float(sector) + 0.5f) / kSectors;
      sum += radiance({flat * std::cos(angle), up, flat * std::sin(angle)});
    }
  return sum * (1.0f / (kRings * kSectors));
}

}  // namespace brickfall::render
