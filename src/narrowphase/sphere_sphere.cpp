#include "narrowphase/features.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collideSphereSphere(const Shape& a, const Shape& b, const Transform& bInA, double margin, Manifold& out) {
  double distance = length(bInA.position);
  double separation = distance - a.radius - b.radius;
  if (!(separation <= margin)) return;
  // Concentric spheres have no direction: upwards is as good as any.
  Vec3 n = distance > 1e-12 * (a.radius + b.radius) ? bInA.position * (1 / distance) : Vec3{0, 1, 0};
  out.normal = n;
  out.count = 1;
  Vec3 onA = n * a.radius;
  out.points[0] = {onA, onA + n * separation, separation, roundPoint(0)};
}

}  // namespace brickfall
