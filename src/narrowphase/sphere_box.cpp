#include <algorithm>

#include "narrowphase/features.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collideSphereBox(const Shape& sphere, const Shape& box, const Transform& bInA, double margin, Manifold& out) {
  // The centre of the sphere in the frame of the box.
  Vec3 h = box.halfExtents;
  Vec3 centre = -rotate(conjugate(bInA.rotation), bInA.position);
  Vec3 nearest{std::clamp(centre.x, -h.x, h.x), std::clamp(centre.y, -h.y, h.y), std::clamp(centre.z, -h.z, h.z)};
  Vec3 gap = centre - nearest;
  double distance = length(gap), separation;
  if (!(distance - sphere.radius <= margin)) return;
  Vec3 outward;  // of the box
  if (distance > 1e-9 * sphere.radius) {
    outward = gap * (1 / distance);
    separation = distance - sphere.radius;
  } else {  // centre inside: out through the nearest face, the first of equally near ones
    int axis = 0;
    for (int k = 1; k < 3; k++)
      if (h[k] - std::fabs(centre[k]) < h[axis] - std::fabs(centre[axis]) - 1e-9 * sphere.radius) axis = k;
    double side = centre[axis] < 0 ? -1 : 1;
    outward[axis] = side;
    nearest[axis] = side * h[axis];
    separation = std::fabs(centre[axis]) - h[axis] - sphere.radius;
  }
  Vec3 n = -rotate(bInA.rotation, outward);
  Vec3 onA = n * sphere.radius;
  out.normal = n;
  out.count = 1;
  out.points[0] = {onA, onA + n * separation, separation, roundPoint(0)};
}

}  // namespace brickfall
