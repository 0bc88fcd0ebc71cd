#include "narrowphase/features.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collidePlaneCapsule(const Shape&, const Shape& capsule, const Transform& bInA, double margin, Manifold& out) {
  Vec3 along = rotate(bInA.rotation, Vec3{0, capsule.halfHeight, 0});
  out.normal = {0, 1, 0};
  for (int end = 0; end < 2; end++) {
    Vec3 centre = end == 0 ? bInA.position - along : bInA.position + along;
    double separation = centre.y - capsule.radius;
    if (!(separation <= margin)) continue;
    out.points[out.count++] = {{centre.x, 0, centre.z}, {centre.x, separation, centre.z}, separation, roundPoint(end)};
  }
}

}  // namespace brickfall
