#include "narrowphase/features.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collidePlaneSphere(const Shape&, const Shape& sphere, const Transform& bInA, double margin, Manifold& out) {
  Vec3 centre = bInA.position;
  double separation = centre.y - sphere.radius;
  if (!(separation <= margin)) return;
  out.normal = {0, 1, 0};
  out.count = 1;
  out.points[0] = {{centre.x, 0, centre.z}, {centre.x, separation, centre.z}, separation, roundPoint(0)};
}

}  // namespace brickfall
