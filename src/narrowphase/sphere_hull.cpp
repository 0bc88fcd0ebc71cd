#include "geometry/queries.h"
#include "narrowphase/features.h"
#include "narrowphase/hull_view.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collideSphereHull(const Shape& sphere, const Shape& hullShape, const Transform& bInA, double margin,
                       Manifold& out) {
  HullStorage storage;
  HullView hull = viewOf(hullShape, storage);
  Vec3 centre = -rotate(conjugate(bInA.rotation), bInA.position);  // of the sphere, in the frame of the hull
  double height = -1e30;
  int face = 0;
  for (int f = 0; f < hull.faceCount; f++) {
    double h = dot(hull.planes[f].normal, centre) - hull.planes[f].offset;
    if (!(h - sphere.radius <= margin)) return;
    if (h > height + 1e-9 * sphere.radius) height = h, face = f;
  }
  Vec3 outward = hull.planes[face].normal;  // centre inside: out through the nearest face
  double distance = height;
  if (height > 1e-9 * sphere.radius) {
    Vec3 gap = centre - closestPoint(hullShape, centre);
    double l = length(gap);
    if (!(l - sphere.radius <= margin)) return;
    if (l > 1e-9 * sphere.radius) {
      distance = l;
      outward = gap * (1 / l);
    }
  }
  Vec3 n = -rotate(bInA.rotation, outward);
  double separation = distance - sphere.radius;
  Vec3 onA = n * sphere.radius;
  out.normal = n;
  out.count = 1;
  out.points[0] = {onA, onA + n * separation, separation, roundPoint(0)};
}

}  // namespace brickfall
