// Random poses, directions and shapes for sweeps, from the project's own generator: the same on every platform.
#pragma once
#include <vector>

#include "brickfall/math.h"
#include "math/random.h"

namespace brickfall::test {

inline Vec3 randomVector(Random& random, double limit) {
  double x = random.between(-limit, limit), y = random.between(-limit, limit);
  return {x, y, random.between(-limit, limit)};
}
// Uniform on the sphere, by rejection.
inline Vec3 randomDirection(Random& random) {
  for (;;) {
    Vec3 v = randomVector(random, 1);
    double squared = lengthSquared(v);
    if (squared > 1e-4 && squared <= 1) return normalized(v);
  }
}
// Uniform over rotations.
inline Quat randomRotation(Random& random) {
  for (;;) {
    Vec3 v = randomVector(random, 1);
    double w = random.between(-1, 1), squared = lengthSquared(v) + w * w;
    if (squared > 1e-4 && squared <= 1) return normalized(Quat{v.x, v.y, v.z, w});
  }
}
inline Transform randomPose(Random& random, double limit) {
  Quat rotation = randomRotation(random);
  return {randomVector(random, limit), rotation};
}
// Points in an ellipsoid, for hulls with `count` corners or fewer.
inline std::vector<Vec3> randomPoints(Random& random, int count, Vec3 halfAxes, bool onSurface = false) {
  std::vector<Vec3> points;
  while (int(points.size()) < count) {
    Vec3 v = randomVector(random, 1);
    if (onSurface) v = randomDirection(random);
    if (lengthSquared(v) <= 1.5) points.push_back(scaled(v, halfAxes));
  }
  return points;
}

}  // namespace brickfall::test
