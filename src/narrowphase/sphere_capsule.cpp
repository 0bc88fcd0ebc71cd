#include <algorithm>

#include "narrowphase/features.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collideSphereCapsule(const Shape& sphere, const Shape& capsule, const Transform& bInA, double margin,
                          Manifold& out) {
  Vec3 axis = rotate(bInA.rotation, Vec3{0, 1, 0});
  double along = std::clamp(-dot(axis, bInA.position), -capsule.halfHeight, capsule.halfHeight);
  Vec3 nearest = bInA.position + axis * along;
  double distance = length(nearest);
  double separation = distance - sphere.radius - capsule.radius;
  if (!(separation <= margin)) return;
  // A centre on the axis may leave any way across it.
  Vec3 n = distance > 1e-12 * (sphere.radius + capsule.radius) ? nearest * (1 / distance)
                                                               : rotate(bInA.rotation, Vec3{1, 0, 0});
  Vec3 onA = n * sphere.radius;
  out.normal = n;
  out.count = 1;
  out.points[0] = {onA, onA + n * separation, separation, roundPoint(0)};
}

}  // namespace brickfall
