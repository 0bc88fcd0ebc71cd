// Strengths that differ from joint to joint.
#pragma once
#include <cmath>

#include "brickfall/math.h"
#include "math/exponential.h"
#include "math/random.h"

namespace brickfall::masonry {

// A log-normal factor of mean 1 with this coefficient of variation, always the same for a seed.
inline double scatterFactor(std::uint64_t seed, double variation) {
  if (!(variation > 0)) return 1;
  Random random(seed);
  double sine, cosine;
  const double radius = std::sqrt(-2 * naturalLog(1 - random.unit()));
  sinCos(6.283185307179586 * random.unit(), sine, cosine);
  const double variance = naturalLog(1 + variation * variation);
  return exponential(std::sqrt(variance) * radius * cosine - 0.5 * variance);
}

}  // namespace brickfall::masonry
