// The convex hull by Qhull, an independent implementation.
#pragma once
#include <cstddef>
#include <vector>

#include "brickfall/math.h"

namespace brickfall::test {

struct QhullAnswer {
  double volume = 0;  // 0: no hull (flat input)
  std::size_t vertices = 0, facets = 0;
  double leastDepth = 0;  // of the origin below the nearest facet, negative outside
  Vec3 leastNormal;       // of that facet
};
QhullAnswer qhull(const std::vector<Vec3>& points);

}  // namespace brickfall::test
